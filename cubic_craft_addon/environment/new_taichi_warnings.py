# SPDX-License-Identifier: GPL-3.0-or-later
"""That Taichi does not work here: worth one message, not one per run."""

from ... import solver

_told = ""


def new_taichi_warnings() -> list[str]:
    """Return what is to be told about Taichi now, as one text or none."""
    global _told
    problem = solver.problem_with_taichi()
    if problem == _told:
        return []
    _told = problem
    return [f"Taichi does not work here ({problem}): NumPy computes instead, which is slower"]
