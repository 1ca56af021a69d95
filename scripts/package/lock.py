# SPDX-License-Identifier: GPL-3.0-or-later
"""Choose the wheels: one version of each package for all platforms and Pythons of a lock."""

import json
import sys
import tempfile
from collections import defaultdict
from pathlib import Path
from urllib.parse import unquote, urlsplit

from packaging.utils import parse_wheel_filename

from . import pip
from .locked import REQUIREMENTS, needed_by_solver
from .targets import NUMPY_OF_BLENDER, PLATFORMS, packages_for
from .wheel import holding

_HEAD = """\
# The wheels in the packages, written by `make lock`. One version each: Blender installs one only.
"""


def write_locks():
    """Write all locks."""
    packages = defaultdict(list)
    for platform in PLATFORMS.values():
        for package in packages_for(platform):
            packages[package.lock].append(package)
    for name, sharing in packages.items():
        write_lock(REQUIREMENTS / name, sharing)


def write_lock(path, packages):
    """Resolve what the solver needs with the oldest NumPy that Blender brings, and write it.

    Parameters
    ----------
    path : Path
    packages : list of Package
        Those that share the lock.
    """
    chosen = defaultdict(dict)  # (name, version): {file name: hash}
    for package in sorted(packages, key=lambda package: package.python):  # "3.11", "3.13"
        for file_name, sha256 in _resolve(package.platform, package.python, list(chosen)):
            name, version, *_ = parse_wheel_filename(file_name)
            if name != "numpy":
                chosen[name, str(version)][file_name] = sha256
    path.write_text(_HEAD + "".join(_entry(*item) for item in sorted(chosen.items())))


def _resolve(platform, python, pinned):
    """Return the file names and hashes of what pip would install."""
    pins = [f"{name}=={version}" for name, version in pinned]
    # pip would evaluate the markers for this machine and the Python that it runs in, and have that
    # Python's consent to each wheel.
    needed = [f"{r.name}{r.specifier}" for r in holding(needed_by_solver(), platform, python)]
    is_newer = tuple(map(int, python.split("."))) > sys.version_info
    with tempfile.TemporaryDirectory() as folder:
        constraints = Path(folder) / "constraints.txt"
        constraints.write_text("\n".join([*pins, f"numpy=={NUMPY_OF_BLENDER[python][0]}"]))
        report = pip.run(
            "install",
            platform,
            python,
            *("--dry-run", "--ignore-installed", f"--target={folder}", "--report=-"),
            *(["--ignore-requires-python"] if is_newer else []),
            *("-c", constraints, *needed),
        )
    for item in json.loads(report)["install"]:
        info = item["download_info"]
        name = unquote(Path(urlsplit(info["url"]).path).name)
        yield name, info["archive_info"]["hashes"]["sha256"]


def _entry(pin, files):
    """Return the lines of one package, with the names of the files as comments."""
    files = sorted(files.items())
    comments = "".join(f"# {name}\n" for name, _ in files)
    hashes = "".join(f" \\\n    --hash=sha256:{sha256}" for _, sha256 in files)
    return f"\n{comments}{pin[0]}=={pin[1]}{hashes}\n"
