# SPDX-License-Identifier: GPL-3.0-or-later
"""Requirements of the solver that not every Blender includes."""

from functools import cache
from importlib.util import find_spec

from ...solver import CubicCraftError


def check_requirements() -> None:
    """Check that SciPy is installed; without Taichi the solver runs in NumPy.

    Raises
    ------
    CubicCraftError
        SciPy is missing.
    """
    if not _has_scipy():
        raise CubicCraftError(
            "CubicCraft needs SciPy, which this Blender does not have; "
            "install the package of CubicCraft for your system, which brings it"
        )


@cache
def _has_scipy():
    return find_spec("scipy") is not None
