# SPDX-License-Identifier: GPL-3.0-or-later
"""What is said of a run: in the panel, on the command line and in reports alike."""

from typing import Any


def crossing_words(crossings: int | None, pressed: int | None) -> tuple[str, bool]:
    """Return what a run says of faces that cross, and whether it has failed to keep some apart.

    The numbers are those of a `Result`; None counts as 0. The text is empty if none cross.

    Examples
    --------
    >>> crossing_words(12, 0)
    ('12 faces still cross', True)
    >>> crossing_words(1361, 1361)
    ('1,361 faces cross: parts press into each other', False)
    >>> crossing_words(None, None)
    ('', False)
    """
    failed = (crossings or 0) - (pressed or 0)
    if failed > 0:
        return f"{failed:,} faces still cross", True
    return (f"{crossings:,} faces cross: parts press into each other" if crossings else ""), False


def numbers_of(result: Any) -> dict[str, Any]:
    """Return what a report has of a `Result`."""
    energies = {name: float(getattr(result.energy, name)) for name in ("total", "arap", "cubic")}
    return {
        "iterations": result.iterations,
        "converged": bool(result.converged),
        "crossings": result.crossings,
        "energy": energies,
    }


def end_words(end: str, run: Any) -> str:
    """Return how a run has ended, and behind it what is said of its `crossings` and `pressed`."""
    crossing, _ = crossing_words(run.crossings, run.pressed)
    return f"{end}, {crossing}" if crossing else end
