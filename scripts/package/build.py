# SPDX-License-Identifier: GPL-3.0-or-later
"""Build the zips: the extension as it is, the wheels, their licences and a bill of materials."""

import shutil
import tempfile
import tomllib
import zipfile
from pathlib import Path

import tomlkit
from build_extension import build

from .bom import bill_of_materials
from .check import BILL, check
from .fetch import fetch
from .inside import check_inside
from .locked import REQUIREMENTS
from .third_party import write_third_party
from .wheel import Wheel

MANIFEST = "blender_manifest.toml"


def build_package(package, plain, output, cache, version=None):
    """Build a package, with its bill of materials beside it.

    Parameters
    ----------
    package
        What is wanted.
    plain : Path
        The zip of the extension without wheels.
    output, cache : Path
        Folders of the zips and of the wheels.
    version : str, optional
        Stands in the manifest in place of that of the extension.

    Returns
    -------
    Path
        The zip, checked.

    Raises
    ------
    SystemExit
        The zip does not hold what it promises.
    """
    paths = fetch(package.platform, package.python, cache, REQUIREMENTS / package.lock)
    with tempfile.TemporaryDirectory(prefix="cubic_craft_package_") as folder:
        source = Path(folder)
        with zipfile.ZipFile(plain) as archive:
            archive.extractall(source)
        manifest = _complete(source, package, paths, version)
        target = output / package.file_name(manifest["version"])
        build(target, source)
        shutil.copy(source / BILL, target.with_suffix(".cdx.json"))
    problems = check(target, package)
    if problems:
        raise SystemExit("\n".join([f"{target.name} is not what it promises:", *problems]))
    return target


def _complete(source, package, paths, version):
    """Add to the extension in a folder what the package has beside it; return its manifest."""
    (source / "wheels").mkdir()
    for path in paths:
        shutil.copy(path, source / "wheels" / path.name)
    wheels = [Wheel.of_path(path) for path in paths]
    credits = write_third_party(source, wheels)
    for path in paths:
        check_inside(path, credits)
    document = tomlkit.parse((source / MANIFEST).read_text())
    document["version"] = version or document["version"]
    document["copyright"].extend(sorted({c for entry in credits for c in entry.copyrights}))
    document["platforms"] = [package.platform.name]
    document["wheels"] = [f"./wheels/{path.name}" for path in paths]
    document.update(package.blender_versions())
    text = tomlkit.dumps(document)
    (source / MANIFEST).write_text(text)
    manifest = tomllib.loads(text)
    bill = bill_of_materials(package, manifest, wheels, credits)
    (source / BILL).write_text(bill)
    return manifest
