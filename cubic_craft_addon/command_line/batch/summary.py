# SPDX-License-Identifier: GPL-3.0-or-later
"""What became of a file of a batch, in one line."""

from typing import Any

from ....solver.console.report import FAILED, KEPT
from ..process.one_line import one_line


def summary(about: dict[str, Any]) -> str:
    """Return one line about a file, without its name, from what `task.do` returns."""
    if about["status"] == FAILED:
        return f"failed: {one_line(about['error'])}"
    if about["status"] == KEPT:
        return "kept, it was done before"
    memory = f", {about['peak_gb']:.2f} GB" if about["peak_gb"] else ""
    return f"{_numbers(about['report'])}, {about['seconds']:.1f} s{memory}"


def _numbers(report: dict[str, Any]) -> str:
    """Return the numbers of all objects of the file together, one after the other per cubeness."""
    if "frames" in report:
        first, last = report["frames"]
        return f"{last - first + 1} frames"
    objects, texts = report["objects"], []
    for runs in zip(*(each["runs"] for each in objects), strict=True):
        end = "converged" if all(run["converged"] for run in runs) else "not converged"
        texts.append(
            f"cubeness {runs[0]['cubeness']}: {max(run['iterations'] for run in runs)} iterations, "
            f"{end}, energy {sum(run['energy']['total'] for run in runs):.4g}"
        )
    return f"{sum(each['vertices'] for each in objects)} vertices, {'; '.join(texts)}"
