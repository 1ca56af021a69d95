# SPDX-License-Identifier: GPL-3.0-or-later
"""Build the zips: the extension as it is, the wheels and their licenses."""

import tempfile
import zipfile
from pathlib import Path

import tomlkit
from build_extension import build

from .fetch import fetch
from .targets import SIZE_LIMIT_BYTES
from .third_party import write_third_party

MANIFEST = "blender_manifest.toml"


def build_package(package, plain, output, is_upload=False):
    """Build a package.

    `package`: what is wanted. `plain`: Path, the zip of the extension without wheels. `output`:
    Path, folder of the zips. `is_upload`: bool, whether the version is that for the extensions
    platform. Returns the path of the zip. Raises SystemExit: Blender's tool refuses it, or it is
    too large for the extensions platform.
    """
    with tempfile.TemporaryDirectory(prefix="cubic_craft_package_") as folder:
        source = Path(folder)
        with zipfile.ZipFile(plain) as archive:
            archive.extractall(source)
        wheels = fetch(package, source / "wheels")
        manifest = _complete(source, package, wheels, is_upload)
        target = output / package.file_name(manifest["version"])
        build(target, source)
    if target.stat().st_size >= SIZE_LIMIT_BYTES:
        raise SystemExit(f"{target.name} has {SIZE_LIMIT_BYTES:,} bytes or more")
    return target


def _complete(source, package, wheels, is_upload):
    """Add to the extension in a folder what the package has beside it; return its manifest."""
    credits = write_third_party(source, wheels)
    manifest = tomlkit.parse((source / MANIFEST).read_text())
    if is_upload:
        manifest["version"] = package.uploaded_version(manifest["version"])
    manifest["copyright"].extend(sorted({c for entry in credits for c in entry.copyrights}))
    manifest["platforms"] = [package.platform.name]
    manifest["wheels"] = [f"./wheels/{path.name}" for path in wheels]
    manifest.update(package.blender_versions())
    (source / MANIFEST).write_text(tomlkit.dumps(manifest))
    return manifest.unwrap()
