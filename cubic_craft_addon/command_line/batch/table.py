# SPDX-License-Identifier: GPL-3.0-or-later
"""The table at the end of a batch, in plain text, for terminals and logs alike."""

import unicodedata
from collections.abc import Iterator
from typing import Any

from ....solver.console.report import FAILED, KEPT
from ..process.one_line import one_line
from .plan import Job

__all__ = ("summary", "table")

HEAD = ("file", "cubeness", "vertices", "iterations", "energy", "converged", "seconds", "output")
LEFT_ALIGNED = (0, 5, 7)
"""columns with words; the others have numbers"""
MOST_OUTPUTS = 3
"""that are listed by their names"""


def table(files: dict[Job, dict[str, Any]]) -> list[str]:
    """Return the lines: one per file and cubeness; of a file that failed, why."""
    rows = [HEAD, *(row for job, about in files.items() for row in _rows(job.label, about))]
    widths = [max(map(_width, column)) for column in zip(*rows, strict=True)]
    return ["  ".join(map(_aligned, row, widths, range(len(HEAD)))).rstrip() for row in rows]


def summary(about: dict[str, Any]) -> str:
    """Return one line about a file, without its name, from what `task.do` returns."""
    if about["status"] == FAILED:
        return f"failed: {one_line(about['error'])}"
    if about["status"] == KEPT:
        return "kept, it was done before"
    if frames := _frames(about["report"]):
        return f"{frames}, {about['seconds']:.1f} s"
    runs = "; ".join(
        f"{run['iterations']} iterations, "
        f"{'converged' if run['converged'] else 'not converged'}, energy {run['energy']:.4g}"
        for run in _runs(about["report"]["objects"])
    )
    return f"{runs}, {about['seconds']:.1f} s"


def _rows(label: str, about: dict[str, Any]) -> Iterator[tuple[str, ...]]:
    name = one_line(label)
    if about["status"] == FAILED:
        yield (name, *[""] * (len(HEAD) - 2), summary(about))
        return
    seconds = f"{about['seconds']:.1f}" + (" (kept)" if about["status"] == KEPT else "")
    outputs = ", ".join(map(one_line, about["outputs"][:MOST_OUTPUTS]))
    if (more := len(about["outputs"]) - MOST_OUTPUTS) > 0:
        outputs += f" and {more} more"
    if frames := _frames(about["report"]):
        yield (name, *[""] * (len(HEAD) - 3), seconds, f"{outputs} ({frames})")
        return
    for run in _runs(about["report"]["objects"]):
        numbers = (str(run["cubeness"]), str(run["vertices"]), str(run["iterations"]))
        energy, converged = f"{run['energy']:.4g}", "yes" if run["converged"] else "no"
        yield (name, *numbers, energy, converged, seconds, outputs)
        name = seconds = outputs = ""


def _frames(report: dict[str, Any]) -> str:
    """Return how many frames an animation has, in words; empty for anything else."""
    if "frames" not in report:
        return ""
    first, last = report["frames"]
    return f"{last - first + 1} frames"


def _runs(objects: list[dict[str, Any]]) -> Iterator[dict[str, Any]]:
    """Give one row of numbers per cubeness, for all objects of the file together."""
    for runs in zip(*(each["runs"] for each in objects), strict=True):
        yield {
            "cubeness": runs[0]["cubeness"],
            "vertices": sum(each["vertices"] for each in objects),
            "iterations": max(run["iterations"] for run in runs),
            "energy": sum(run["energy"]["total"] for run in runs),
            "converged": all(run["converged"] for run in runs),
        }


def _aligned(text: str, width: int, column: int) -> str:
    space = " " * (width - _width(text))
    return text + space if column in LEFT_ALIGNED else space + text


def _width(text: str) -> int:
    """Return how many columns of a terminal a text takes."""
    wide = sum(unicodedata.east_asian_width(c) in "WF" for c in text)
    return len(text) + wide - sum(unicodedata.combining(c) > 0 for c in text)
