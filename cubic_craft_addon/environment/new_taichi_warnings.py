# SPDX-License-Identifier: GPL-3.0-or-later
"""A warning that Taichi does not work here: shown once, not in every run."""

from ... import solver

_told = ""


def new_taichi_warnings() -> list[str]:
    """Return new warnings about Taichi, as a list of one text or none."""
    global _told
    problem = solver.problem_with_taichi()
    if problem == _told:
        return []
    _told = problem
    return [f"Taichi does not work here ({problem}): NumPy computes instead, which is slower"]
