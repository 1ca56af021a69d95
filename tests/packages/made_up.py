# SPDX-License-Identifier: GPL-3.0-or-later
"""Small wheels and packages of our own making, right or wrong in one point."""

import hashlib
import json
import zipfile
from io import BytesIO

from packaging.requirements import Requirement

from scripts.package.targets import PLATFORMS, Package

LINUX = PLATFORMS["linux-x64"]
PACKAGE = Package(LINUX, "3.13")
NEEDED = [Requirement("fast"), Requirement("plain>=1.0")]


def wheel(name, tags, version="1.0", requires=(), files=(), fields=("License: MIT",)):
    """Return the name and the bytes of a wheel; `files` are names, or texts by name."""
    lines = ["Metadata-Version: 2.1", f"Name: {name}", f"Version: {version}", *fields]
    lines += [f"Requires-Dist: {text}" for text in requires]
    info = f"{name}-{version}.dist-info"
    content = BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        texts = dict(files) if isinstance(files, dict) else dict.fromkeys(files, "")
        texts[f"{info}/METADATA"] = "\n".join(lines) + "\n\n"
        texts[f"{info}/LICENSE"] = "MIT License\n\nCopyright (c) 2020-2026 The Makers\n"
        for file, text in texts.items():
            # The date of ZipInfo is fixed: that of a plain name is now, and changes the hash.
            archive.writestr(zipfile.ZipInfo(file), text)
    return f"{name}-{version}-{tags}.whl", content.getvalue()


def good_wheels():
    """Return the wheels of a package for Linux and Python 3.13, by name."""
    return dict(
        [
            wheel("fast", "cp312-abi3-manylinux_2_28_x86_64", requires=["numpy>=1.23"]),
            wheel("plain", "py3-none-any", requires=["deep~=1.0", "extra_only; extra == 'x'"]),
            wheel("deep", "py2.py3-none-any"),
        ]
    )


def lock_of(wheels):
    """Return the lock with exactly these wheels."""
    locked = {}
    for file, content in wheels.items():
        locked.setdefault(file.split("-")[0], ("1.0", set()))[1].add(sha256(content))
    return locked


def sha256(content):
    return hashlib.sha256(content).hexdigest()


def package(
    path, wheels, listed=None, platforms=("linux-x64",), without=(), bill=None, files=(), **fields
):
    """Write a package with these wheels and files; the manifest and the bill may list others."""
    listed = wheels if listed is None else listed
    manifest = {
        "id": "cubic_craft",
        "version": "1.2.3",
        "blender_version_min": "4.2.0",
        "platforms": list(platforms),
        "wheels": [f"./wheels/{name}" for name in listed],
        **fields,
    }
    billed = wheels if bill is None else bill
    parts = [{"hashes": [{"content": sha256(content)}]} for content in billed.values()]
    texts = {"THIRD_PARTY.md": "", "sbom.cdx.json": json.dumps({"components": parts})}
    texts |= dict(files)
    texts |= {f"licences/{name.split('-')[0]}/LICENSE": "" for name in wheels}
    texts["blender_manifest.toml"] = "".join(
        f"{name} = {json.dumps(value)}\n" for name, value in manifest.items()
    )
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in texts.items():
            if name not in without:
                archive.writestr(name, content)
        for name, content in wheels.items():
            archive.writestr(f"wheels/{name}", content)
    return path
