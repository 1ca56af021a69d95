# SPDX-License-Identifier: GPL-3.0-or-later
"""What the packages promise: on which platforms and for which Pythons they work."""

from dataclasses import dataclass, replace
from pathlib import Path

from packaging import tags

REQUIREMENTS = Path(__file__).resolve().parents[2] / "requirements"
PYTHONS = ("3.11", "3.13")  # of Blender 4.2 to 5.0, and from 5.1 on
NEWEST_PYTHON = "3.14"  # of distributions; with Quadrants, as Taichi has no wheels for it
NEW_PYTHON_BLENDER = "5.1.0"  # the first with the second of them, where Blender brings Python
SIZE_LIMIT_BYTES = 200_000_000  # what the extensions platform takes at most


@dataclass(frozen=True)
class Platform:
    """A platform that Blender knows.

    `wheel_tags` are the last parts of the names of wheels that run there. `brings_python` is False
    where a distribution's Blender may use another Python than Blender's own of that version.
    `pythons` are those of its packages.
    """

    name: str
    wheel_tags: tuple[str, ...]
    brings_python: bool = True
    pythons: tuple[str, ...] = PYTHONS


# Blender itself needs glibc 2.28; SciPy has no wheel for an Apple processor before macOS 12.
def _linux(name, machine, pythons):
    newer = (f"manylinux_2_{minor}_{machine}" for minor in range(28, 16, -1))
    return Platform(name, (*newer, f"manylinux2014_{machine}"), False, pythons)


PLATFORMS = {
    platform.name: platform
    for platform in (
        Platform("windows-x64", ("win_amd64",)),
        Platform("macos-arm64", tuple(tags.mac_platforms((12, 0), "arm64"))),
        _linux("linux-x64", "x86_64", (*PYTHONS, NEWEST_PYTHON)),
        _linux("linux-arm64", "aarch64", (NEWEST_PYTHON,)),
    )
}

UPLOADED = ("windows-x64", "macos-arm64", "linux-x64")  # of those that the platform knows


@dataclass(frozen=True)
class Package:
    """One zip: a platform and the Python that it promises to work with.

    Two Pythons in one zip are more than the extensions platform takes, on Windows and Linux; each
    user would also download twice as much as is used.
    """

    platform: Platform
    python: str

    def file_name(self, version):
        """Return the name of the zip, which says whom it is for."""
        return f"cubic_craft-{version}-{self.platform.name.replace('-', '_')}-{self._suffix()}.zip"

    def _suffix(self):
        if not self.platform.brings_python:
            return f"python{self.python}"
        return "blender4.2_to_5.0" if self.python == PYTHONS[0] else "blender5.1_or_newer"

    def blender_versions(self):
        """Return the fields of the manifest that keep it from Blenders with another Python.

        None on a platform where the version does not tell the Python; Blender then goes by the
        names of the wheels.
        """
        if not self.platform.brings_python:
            return {}
        if self.python == PYTHONS[0]:
            return {"blender_version_max": NEW_PYTHON_BLENDER}  # the first that it is not for
        return {"blender_version_min": NEW_PYTHON_BLENDER}

    def uploaded_version(self, release):
        """Return the version that it is uploaded as: the release, or the number after it.

        On the extensions platform, a version has one file for each platform. As two Pythons do not
        fit into one file, each range of Blender versions has a version of its own.

        Raises SystemExit: the last number of the release is odd: that is for newer Blenders of the
        one before.
        """
        major, minor, patch = map(int, release.split("."))
        if patch % len(PYTHONS):
            raise SystemExit(
                f"{release} cannot be uploaded: the last number of a release is even, as the odd "
                "one after it is the same release for newer Blenders"
            )
        return f"{major}.{minor}.{patch + PYTHONS.index(self.python)}"

    @property
    def lock(self):
        """Return the path of the file that locks its wheels, which ``make lock`` writes."""
        if self.python == NEWEST_PYTHON:
            return REQUIREMENTS / f"wheels_{self.platform.name}_python{self.python}.lock"
        return REQUIREMENTS / "wheels.lock"


def packages_for(platform):
    """Return the packages of a platform."""
    return [Package(platform, python) for python in platform.pythons]


def packages_to_upload():
    """Return those for the extensions platform, which all say for which Blenders they are.

    They are for Blenders from blender.org, whose version tells the Python, also on Linux.
    """
    platforms = [replace(PLATFORMS[name], brings_python=True) for name in UPLOADED]
    return [Package(platform, python) for python in PYTHONS for platform in platforms]
