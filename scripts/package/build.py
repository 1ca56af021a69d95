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
from .locked import REQUIREMENTS
from .targets import SIZE_LIMIT_BYTES
from .third_party import write_third_party
from .wheel import Wheel

MANIFEST = "blender_manifest.toml"


def build_platform(platform_package, plain, output, cache):
    """Build the package of a platform; if it is too large, one for each Python.

    Parameters
    ----------
    platform_package
        What is wanted.
    plain : Path
        The zip of the extension without wheels.
    output, cache : Path
        Folders of the zips and of the wheels.

    Returns
    -------
    list of Path
        The zips, all checked.

    Raises
    ------
    SystemExit
        A zip does not hold what it promises.
    """
    if len(platform_package.pythons) > 1 and _size(platform_package, cache) > SIZE_LIMIT_BYTES:
        parts = platform_package.split()
        return [path for part in parts for path in build_platform(part, plain, output, cache)]
    with tempfile.TemporaryDirectory(prefix="cubic_craft_package_") as folder:
        source = Path(folder)
        with zipfile.ZipFile(plain) as archive:
            archive.extractall(source)
        manifest = _complete(source, platform_package, _wheel_paths(platform_package, cache))
        target = output / platform_package.file_name(manifest["version"])
        build(target, source)
        shutil.copy(source / BILL, target.with_suffix(".cdx.json"))
    problems = check(target, platform_package)
    if problems:
        raise SystemExit("\n".join([f"{target.name} is not what it promises:", *problems]))
    return [target]


def _size(package, cache):
    """Return how large the zip gets at least: Blender's tool does not compress wheels again."""
    return sum(path.stat().st_size for path in _wheel_paths(package, cache))


def _wheel_paths(package, cache):
    """Return the path of each file once, also of those that are for several Pythons."""
    lock = REQUIREMENTS / package.lock
    found = [fetch(package.platform, python, cache, lock) for python in package.pythons]
    paths = [path for wheels in found for path in wheels]
    return list({path.name: path for path in paths}.values())


def _complete(source, package, paths):
    """Add to the extension in a folder what the package has beside it; return its manifest."""
    (source / "wheels").mkdir()
    for path in paths:
        shutil.copy(path, source / "wheels" / path.name)
    wheels = [Wheel.of_path(path) for path in paths]
    credits = write_third_party(source, wheels)
    document = tomlkit.parse((source / MANIFEST).read_text())
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
