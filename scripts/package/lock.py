# SPDX-License-Identifier: GPL-3.0-or-later
"""Choose the wheels: one version of each package for all platforms and Pythons."""

import json
import tempfile
from collections import defaultdict
from pathlib import Path
from urllib.parse import unquote, urlsplit

from packaging.utils import parse_wheel_filename

from . import pip
from .locked import LOCK, SOLVER
from .targets import NUMPY_OF_BLENDER, PLATFORMS, PYTHONS

_HEAD = """\
# The wheels in the packages, written by `make lock`. One version each: Blender installs one only.
"""


def write_lock(path=LOCK):
    """Resolve what the solver needs with the oldest NumPy that Blender brings, and write it."""
    chosen = defaultdict(dict)  # (name, version): {file name: hash}
    for python in PYTHONS:
        for platform in PLATFORMS.values():
            for file_name, sha256 in _resolve(platform, python, [pin for pin in chosen]):
                name, version, *_ = parse_wheel_filename(file_name)
                if name != "numpy":
                    chosen[name, str(version)][file_name] = sha256
    path.write_text(_HEAD + "".join(_entry(*item) for item in sorted(chosen.items())))


def _resolve(platform, python, pinned):
    """Return the file names and hashes of what pip would install."""
    pins = [f"{name}=={version}" for name, version in pinned]
    with tempfile.TemporaryDirectory() as folder:
        constraints = Path(folder) / "constraints.txt"
        constraints.write_text("\n".join([*pins, f"numpy=={NUMPY_OF_BLENDER[python][0]}"]))
        report = pip.run(
            "install",
            platform,
            python,
            *("--dry-run", "--ignore-installed", f"--target={folder}", "--report=-"),
            *("-r", SOLVER, "-c", constraints),
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
