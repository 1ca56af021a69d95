# SPDX-License-Identifier: GPL-3.0-or-later
"""That the engine does not work here: told in the section Solver, and once on the command line."""

from ... import solver

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
