# SPDX-License-Identifier: GPL-3.0-or-later
"""What the packages promise: on which platforms and for which Pythons they work."""

from dataclasses import dataclass, replace

from packaging import tags

PYTHONS = ("3.11", "3.13")  # of Blender 4.2 to 5.0, and from 5.1 on
NEWEST_PYTHON = "3.14"  # of distributions; with Quadrants, as Taichi has no wheels for it
NEW_PYTHON_BLENDER = "5.1.0"  # the first with the second of them, where Blender brings Python

# A wheel must work with each. Python 3.11: Blender 4.2, 4.4 to 5.0. Python 3.13: Debian 13, 5.1.
# Python 3.14: the oldest that Quadrants takes, and Debian's.
NUMPY_OF_BLENDER = {
    "3.11": ("1.24.3", "1.26.4"),
    "3.13": ("2.2.4", "2.3.4"),
    "3.14": ("2.3.4", "2.4.6"),
}

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
    sys_platform: str
    system: str
    machine: str
    brings_python: bool = True
    pythons: tuple[str, ...] = PYTHONS

    def markers(self, python):
        """Return what the markers of dependencies are evaluated with."""
        return {
            "sys_platform": self.sys_platform,
            "platform_system": self.system,
            "platform_machine": self.machine,
            "os_name": "nt" if self.system == "Windows" else "posix",
            "platform_python_implementation": "CPython",
            "implementation_name": "cpython",
            "python_version": python,
            "python_full_version": f"{python}.0",
            "extra": "",
        }

    def tags(self, python):
        """Return the tags of the wheels that this Python can import there."""
        version = tuple(map(int, python.split(".")))
        interpreter = "cp" + python.replace(".", "")
        native = tags.cpython_tags(version, platforms=self.wheel_tags)
        return {*native, *tags.compatible_tags(version, interpreter, self.wheel_tags)}


# Blender itself needs glibc 2.28; SciPy has no wheel for an Apple processor before macOS 12.
def _manylinux(machine):
    newer = (f"manylinux_2_{minor}_{machine}" for minor in range(28, 16, -1))
    return *newer, f"manylinux2014_{machine}"


PLATFORMS = {
    platform.name: platform
    for platform in (
        Platform("windows-x64", ("win_amd64",), "win32", "Windows", "AMD64"),
        Platform(
            "macos-arm64",
            tuple(tags.mac_platforms((12, 0), "arm64")),
            "darwin",
            "Darwin",
            "arm64",
        ),
        Platform(
            "linux-x64",
            _manylinux("x86_64"),
            "linux",
            "Linux",
            "x86_64",
            brings_python=False,
            pythons=(*PYTHONS, NEWEST_PYTHON),
        ),
        Platform(
            "linux-arm64",
            _manylinux("aarch64"),
            "linux",
            "Linux",
            "aarch64",
            brings_python=False,
            pythons=(NEWEST_PYTHON,),
        ),
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

    @property
    def lock(self):
        """Return the name of the file that locks its wheels.

        Each package for the newest Python has its own: on Arm, some of what it needs has no wheel.
        """
        if self.python == NEWEST_PYTHON:
            return f"wheels_{self.platform.name}_python{self.python}.lock"
        return "wheels.lock"


def packages_for(platform):
    """Return the packages of a platform."""
    return [Package(platform, python) for python in platform.pythons]


def packages_to_upload():
    """Return those for the extensions platform, which all say for which Blenders they are.

    They are for Blenders from blender.org, whose version tells the Python, also on Linux.
    """
    platforms = [replace(PLATFORMS[name], brings_python=True) for name in UPLOADED]
    return [Package(platform, python) for python in PYTHONS for platform in platforms]


def all_packages():
    """Return all packages that there can be."""
    ours = [package for platform in PLATFORMS.values() for package in packages_for(platform)]
    return list(dict.fromkeys([*ours, *packages_to_upload()]))
