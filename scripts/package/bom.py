# SPDX-License-Identifier: GPL-3.0-or-later
"""The software bill of materials of a package, in the form of CycloneDX."""
# pyright: reportCallIssue=false
# The decorators of the library hide the parameters of its classes.

import hashlib

from cyclonedx.model import HashAlgorithm, HashType
from cyclonedx.model.bom import Bom
from cyclonedx.model.component import Component, ComponentType
from cyclonedx.model.license import LicenseExpression
from cyclonedx.output.json import JsonV1Dot6
from packageurl import PackageURL


def bill_of_materials(manifest, wheels, credits):
    """Return it as JSON text: the extension, and each wheel with its hash.

    `manifest`: the manifest of the extension, a dictionary. `wheels`, `credits`: the paths of what
    is bundled, and the license of each.
    """
    root = Component(
        name=manifest["id"],
        version=manifest["version"],
        type=ComponentType.APPLICATION,
        licenses=[LicenseExpression(manifest["license"][0].removeprefix("SPDX:"))],
    )
    parts = [_component(*each) for each in zip(wheels, credits, strict=True)]
    bom = Bom(components=parts)
    bom.metadata.component = root
    bom.register_dependency(root, parts)
    return JsonV1Dot6(bom).output_as_string(indent=2)


def _component(path, entry):
    content = hashlib.sha256(path.read_bytes()).hexdigest()
    return Component(
        name=entry.name,
        version=entry.version,
        type=ComponentType.LIBRARY,
        bom_ref=path.name,
        purl=PackageURL("pypi", None, entry.name, entry.version, {"file_name": path.name}),
        hashes=[HashType(alg=HashAlgorithm.SHA_256, content=content)],
        licenses=[LicenseExpression(entry.licence)],
        copyright="\n".join(entry.copyrights),
    )
