"""The report of a batch: all files in one."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..output_files import replacing
from .outcome import FAILED, Outcome, counts

__all__ = ("write_batch_report",)


def write_batch_report(
    path: Path, outcomes: Sequence[Outcome], output_folder: Path, seconds: float
) -> None:
    """Write the report as JSON.

    Parameters
    ----------
    seconds : that the whole batch took

    Raises
    ------
    InputError
        It cannot be written.
    """
    report = {
        "output_folder": str(output_folder.resolve()),
        "counts": counts(outcomes),
        "files": [_file(outcome, output_folder.resolve()) for outcome in outcomes],
        "seconds": {"total": seconds},
    }
    with replacing(path) as temporary:
        temporary.write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")


def _file(outcome: Outcome, output_folder: Path) -> dict[str, Any]:
    common = {"input": str(outcome.job.source.path), "status": outcome.status}
    if outcome.status == FAILED:
        return common | {"error": outcome.error}
    outputs = [path.relative_to(output_folder).as_posix() for path in outcome.job.outputs]
    return common | {"outputs": outputs, "seconds": outcome.seconds, "report": outcome.report}
