# SPDX-License-Identifier: GPL-3.0-or-later
"""What is uploaded to the extensions platform, where a version has one file for each platform.

As two Pythons do not fit into one file, each range of Blender versions has a version of its own.
The platform asks Blender for its version and offers the newest of ours that is for it.
"""

import tomllib
import zipfile
from collections import defaultdict
from itertools import pairwise

from .targets import PYTHONS


def release_of(plain):
    """Return the version of the extension in a zip (Path)."""
    return _manifest(plain)["version"]


def uploaded_version(release, package):
    """Return the version that a package is uploaded as: the release, or the number after it.

    Raises
    ------
    SystemExit
        The last number of the release is odd: that is for the newer Blenders of the one before.
    """
    major, minor, patch = map(int, release.split("."))
    if patch % len(PYTHONS):
        raise SystemExit(
            f"{release} cannot be uploaded: the last number of a release is even, as the odd one "
            "after it is the same release for newer Blenders"
        )
    return f"{major}.{minor}.{patch + PYTHONS.index(package.python)}"


def upload_problems(paths):
    """Return what the platform, or a Blender that asks it, would object to, as a list of str.

    Parameters
    ----------
    paths : list of Path
        All zips of a release.
    """
    problems = []
    ranges = defaultdict(list)  # by platform: (first Blender, first that is too new, version)
    for manifest in map(_manifest, paths):
        first = _numbers(manifest["blender_version_min"])
        end = _numbers(manifest.get("blender_version_max", "999.0.0"))
        for platform in manifest["platforms"]:
            ranges[platform].append((first, end, _numbers(manifest["version"])))
    for platform, found in ranges.items():
        found.sort()
        if len({version for *_, version in found}) < len(found):
            problems.append(f"{platform} has two files in one version")
        for older, newer in pairwise(found):
            if newer[0] != older[1]:
                problems.append(f"the files for {platform} do not meet at one version of Blender")
            if newer[2] < older[2]:
                problems.append(f"on {platform}, newer Blenders have the older version")
    if len(set(map(tuple, ranges.values()))) > 1:
        problems.append("a version is not for the same Blenders on all platforms")
    return problems


def _manifest(path):
    with zipfile.ZipFile(path) as archive:
        return tomllib.loads(archive.read("blender_manifest.toml").decode())


def _numbers(version):
    return tuple(map(int, version.split(".")))
