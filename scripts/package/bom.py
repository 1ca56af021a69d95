# SPDX-License-Identifier: GPL-3.0-or-later
"""The software bill of materials of a package, in the form of CycloneDX."""
# pyright: reportCallIssue=false
# The decorators of the library hide the parameters of its classes.

from cyclonedx.model import HashAlgorithm, HashType, Property
from cyclonedx.model.bom import Bom
from cyclonedx.model.component import Component, ComponentType
from cyclonedx.model.contact import OrganizationalEntity
from cyclonedx.model.license import LicenseExpression
from cyclonedx.output.json import JsonV1Dot6
from packageurl import PackageURL

from .wheel import requirement_name


def bill_of_materials(package, manifest, wheels, credits):
    """Return it as JSON text: the extension, each wheel with its hash, and what needs what.

    Parameters
    ----------
    package
        The platform and the Python.
    manifest
        The manifest of the extension, a dictionary.
    wheels, credits
        What is bundled, and the licence of each.
    """
    licences = {entry.name: entry for entry in credits}
    root = Component(
        name=manifest["id"],
        version=manifest["version"],
        type=ComponentType.APPLICATION,
        bom_ref=manifest["id"],
        licenses=[LicenseExpression(manifest["license"][0].removeprefix("SPDX:"))],
        supplier=OrganizationalEntity(name=manifest["maintainer"]),
        properties=[Property(name="blender:platform", value=package.platform.name)],
    )
    bom = Bom()
    bom.metadata.component = root
    parts = {wheel: _component(wheel, licences[wheel.name]) for wheel in wheels}
    for part in parts.values():
        bom.components.add(part)
    bom.register_dependency(root, parts.values())
    for wheel, part in parts.items():
        bom.register_dependency(part, _needed(package, wheel, parts))
    return JsonV1Dot6(bom).output_as_string(indent=2)


def _component(wheel, entry):
    return Component(
        name=wheel.name,
        version=wheel.version,
        type=ComponentType.LIBRARY,
        bom_ref=wheel.file_name,
        purl=PackageURL("pypi", None, wheel.name, wheel.version, {"file_name": wheel.file_name}),
        hashes=[HashType(alg=HashAlgorithm.SHA_256, content=wheel.sha256)],
        licenses=[LicenseExpression(entry.licence)],
        copyright="\n".join(entry.copyrights),
        properties=[Property(name="cubic_craft:inside", value=line) for line in entry.inside],
    )


def _needed(package, wheel, parts):
    """Return the components that the wheel requires."""
    required = wheel.requirements(package.platform, package.python)
    names = {requirement_name(requirement) for requirement in required}
    return [part for other, part in parts.items() if other.name in names]
