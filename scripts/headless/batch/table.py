"""The table at the end of a batch, in plain text, for terminals and logs alike."""

import unicodedata
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from .outcome import FAILED, KEPT, Outcome

__all__ = ("one_line", "summary", "table")

HEAD = ("file", "cubeness", "vertices", "iterations", "energy", "converged", "seconds", "output")
LEFT_ALIGNED = (0, 5, 7)
"""columns with words; the others have numbers"""
MOST_OUTPUTS = 3
"""that are listed by their names"""


def table(outcomes: Iterable[Outcome], output_folder: Path) -> list[str]:
    """Return the lines: one per file and cubeness; of a file that failed, why."""
    rows = [HEAD]
    for outcome in outcomes:
        rows += _rows(outcome, output_folder.resolve())
    widths = [max(_width(row[column]) for row in rows) for column in range(len(HEAD))]
    return ["  ".join(_cells(row, widths)).rstrip() for row in rows]


def summary(outcome: Outcome) -> str:
    """Return one line about a file, without its name."""
    if outcome.status == FAILED:
        return f"failed: {one_line(outcome.error)}"
    if outcome.status == KEPT:
        return "kept, it was done before"
    runs = "; ".join(
        f"{run['iterations']} iterations, "
        f"{'converged' if run['converged'] else 'not converged'}, energy {run['energy']:.4g}"
        for run in _runs(outcome)
    )
    return f"{runs}, {outcome.seconds:.1f} s"


def one_line(text: str) -> str:
    """Return a text, such as a file's name, as it can be printed in one line."""
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)


def _rows(outcome: Outcome, output_folder: Path) -> list[tuple[str, ...]]:
    name = one_line(outcome.job.source.label)
    if outcome.status == FAILED:
        return [(name, "", "", "", "", "", "", f"failed: {one_line(outcome.error)}")]
    seconds = f"{outcome.seconds:.1f}" + (" (kept)" if outcome.status == KEPT else "")
    rows = []
    for run in _runs(outcome):
        numbers = (str(run["cubeness"]), str(run["vertices"]), str(run["iterations"]))
        energy, converged = f"{run['energy']:.4g}", "yes" if run["converged"] else "no"
        rows.append((name, *numbers, energy, converged, seconds, _outputs(outcome, output_folder)))
        name = seconds = ""
    return [row if number == 0 else (*row[:-1], "") for number, row in enumerate(rows)]


def _runs(outcome: Outcome) -> list[dict[str, Any]]:
    """Return one row of numbers per cubeness, for all objects of the file together."""
    assert outcome.report is not None
    objects = outcome.report["objects"]
    together = []
    for runs in zip(*(each["runs"] for each in objects), strict=True):
        together.append(
            {
                "cubeness": runs[0]["cubeness"],
                "vertices": sum(each["vertices"] for each in objects),
                "iterations": max(run["iterations"] for run in runs),
                "energy": sum(run["energy"]["total"] for run in runs),
                "converged": all(run["converged"] for run in runs),
            }
        )
    return together


def _outputs(outcome: Outcome, output_folder: Path) -> str:
    names = [path.relative_to(output_folder).as_posix() for path in outcome.job.outputs]
    more = len(names) - MOST_OUTPUTS
    listed = ", ".join(one_line(name) for name in names[:MOST_OUTPUTS])
    return f"{listed} and {more} more" if more > 0 else listed


def _cells(row: tuple[str, ...], widths: list[int]) -> list[str]:
    cells = []
    for number, (cell, width) in enumerate(zip(row, widths, strict=True)):
        space = " " * (width - _width(cell))
        cells.append(cell + space if number in LEFT_ALIGNED else space + cell)
    return cells


def _width(text: str) -> int:
    """Return how many columns of a terminal a text takes."""
    wide = sum(unicodedata.east_asian_width(c) in "WF" for c in text)
    return len(text) + wide - sum(unicodedata.combining(c) > 0 for c in text)
