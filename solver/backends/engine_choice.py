# SPDX-License-Identifier: GPL-3.0-or-later
"""Which engine compiles the kernels: Taichi, or Quadrants where there is no Taichi.

Quadrants goes on where Taichi has stopped: the same language and the same numbers, under another
name, with wheels for newer Pythons. Kernels are written once; `taichi` in the name of a file means
the language. Nothing here imports an engine: `engine.py` does.
"""

import platform
import sys
from functools import cache
from importlib.util import find_spec
from typing import Any, NamedTuple


class Engine(NamedTuple):
    """What compiles the kernels."""

    name: str
    """as its users know it"""
    package: str
    """what is imported and installed"""
    greeting: str
    """the environment variable that "False" keeps it from announcing itself with"""
    log_level: str
    """that which says what it tells besides, such as that it is in a notebook"""


TAICHI = Engine("Taichi", "taichi", "ENABLE_TAICHI_HEADER_PRINT", "TI_LOG_LEVEL")
QUADRANTS = Engine("Quadrants", "quadrants", "ENABLE_QUADRANTS_HEADER_PRINT", "QD_LOG_LEVEL")


@cache
def engine() -> Engine:
    """Return the Engine that is installed, Taichi before Quadrants, or else the one to install."""
    return next(filter(_is_installed, (TAICHI, QUADRANTS)), _engine_with_wheels())


def engine_name() -> str:
    """Return the name of the engine that computes here, or would if it were installed."""
    return engine().name


def started_program() -> Any:
    """Return the engine's program, ours or that of others, or None if it has not started."""
    try:
        runtime = sys.modules[engine().package].lang.impl.get_runtime()
    except (KeyError, AttributeError):  # not imported, not wholly, or broken
        return None
    # Quadrants raises where one asks it for a program that it does not have.
    return getattr(runtime, "_prog" if hasattr(runtime, "_prog") else "prog", None)


def _is_installed(candidate):
    try:
        spec = find_spec(candidate.package)
    except ValueError:  # imported by hand, from nowhere
        return False
    return spec is not None and spec.origin is not None  # else a folder that was left behind


def _engine_with_wheels():
    """Return the engine that has wheels for this Python and this processor."""
    is_arm_linux = sys.platform == "linux" and platform.machine() == "aarch64"
    return QUADRANTS if sys.version_info >= (3, 14) or is_arm_linux else TAICHI
