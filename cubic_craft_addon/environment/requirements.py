# SPDX-License-Identifier: GPL-3.0-or-later
"""Requirements of the solver that not every Blender includes, or that are broken in some.

That the engine does not work is told in the section Solver, and once on the command line.

All extensions share one SciPy: the first that is found. If another extension has brought one that
does not fit this Blender, it is there and cannot be imported.
"""

from functools import cache
from importlib.util import find_spec

from ... import solver
from ...solver import CubicCraftError

_broken = ""
"""why SciPy cannot be imported, once that was tried"""


def check_requirements() -> None:
    """Check that SciPy works, before it is used; without an engine NumPy solves.

    Raises CubicCraftError: SciPy is missing, or it cannot be imported.
    """
    check_known_requirements()
    try:  # what every run imports
        import scipy.sparse
        import scipy.spatial.transform  # noqa: F401
    except Exception as error:  # a broken installation can raise anything
        global _broken
        _broken = _in_one_line(error)
        raise CubicCraftError(_broken) from error


def check_known_requirements() -> None:
    """Do as `check_requirements`, but import nothing: for each redraw.

    Raises CubicCraftError: SciPy is missing, or an earlier check has found that it cannot be
    imported.
    """
    if not _has_scipy():
        raise CubicCraftError(
            "CubicCraft needs SciPy, which this Blender does not have; "
            "install the package of CubicCraft for your system, which brings it"
        )
    if _broken:
        raise CubicCraftError(_broken)


@cache
def _has_scipy():
    return find_spec("scipy") is not None


def _in_one_line(error: Exception) -> str:
    lines = str(error).strip().splitlines()
    reason = lines[0].rstrip(".") if lines else type(error).__name__
    spec = find_spec("scipy")
    place = "it" if spec is None or not spec.origin else spec.origin
    # What is longest comes last: Blender cuts texts of buttons.
    return (
        f"CubicCraft needs SciPy, which does not work here ({reason}): remove or update the "
        f"extension that brought {place}, and restart Blender"
    )


_problem = _told = ""


def look_at_engine() -> None:
    """Look whether Taichi or Quadrants works, once a run has tried it."""
    global _problem
    _problem = solver.problem_with_engine()


def engine_note() -> str:
    """Return what is known to be wrong with it as a sentence, or an empty text. It is cheap."""
    if not _problem:
        return ""
    name = solver.engine_name()
    return f"{name} does not work here ({_problem}): NumPy computes instead, which is slower"


def new_engine_warnings() -> list[str]:
    """Return the note if it was not returned before, as a list of one text or none."""
    global _told
    look_at_engine()
    note = engine_note()
    if note == _told:
        return []
    _told = note
    return [note] if note else []
