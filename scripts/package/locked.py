# SPDX-License-Identifier: GPL-3.0-or-later
"""The lock, a requirements file with hashes that pip reads as well, and what must be bundled."""

import re
from pathlib import Path

from packaging.requirements import Requirement

from .wheel import requirement_name

REQUIREMENTS = Path(__file__).resolve().parents[2] / "requirements"
SOLVER = REQUIREMENTS / "solver.txt"

_HASH = re.compile(r"--hash=sha256:([0-9a-f]{64})")


def read_lock(path):
    """Return for each name its version and the set of its hashes."""
    locked = {}
    for line in _lines(path):
        requirement = Requirement(line.split("--hash")[0])
        (pin,) = requirement.specifier
        locked[requirement_name(requirement)] = pin.version, frozenset(_HASH.findall(line))
    return locked


def needed_by_solver():
    """Return the requirements of the solver itself."""
    return [Requirement(line) for line in _lines(SOLVER)]


def _lines(path):
    """Return the logical lines without comments."""
    text = re.sub(r"(^|\s)#.*", "", path.read_text(), flags=re.MULTILINE)
    joined = text.replace("\\\n", " ")
    return [line.strip() for line in joined.splitlines() if line.strip()]
