# SPDX-License-Identifier: GPL-3.0-or-later
"""Many files, one after the other: what became of each is told, and in a report."""

import json
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from .output import InputError, replacing

DONE, KEPT, FAILED = "done", "kept", "failed"
"""what became of a file; kept is what an earlier run has done"""
NOTHING_DONE, SOME_FAILED = 2, 3
"""exit codes"""


def one_by_one(
    jobs: Iterable[tuple[str, Any]],
    work: Callable[[Any], dict[str, Any]],
    say: Callable[[str], None],
    report: Path | None,
) -> int:
    """Do all jobs, also where some fail, and return the exit code.

    `jobs`: each with the file that it is about. `work`: does one and returns what the report has of
    it; raises InputError if that cannot be done. `say`: prints a line about what is wrong.
    `report`: the file of JSON that is written anew after each job, so that one that is interrupted
    has it too; None for no report.
    """
    jobs, files, error, begin = list(jobs), [], "", time.perf_counter()
    for source, job in jobs:
        try:
            about = {"status": DONE, **work(job)}
        except Exception as reason:
            if not isinstance(reason, InputError):
                traceback.print_exc()
                reason = InputError(f"{source}: {type(reason).__name__}: {reason}")
            say(f"error: {reason}")
            about = {"status": FAILED, "error": str(reason)}
        files.append({"input": source, **about})
        if report:
            seconds, unfinished = {"total": time.perf_counter() - begin}, len(jobs) - len(files)
            head = {"counts": _counts(files), "unfinished": unfinished, "seconds": seconds}
            try:
                write_json(report, {**head, "files": files})
                error = ""
            except InputError as reason:
                error = str(reason)
    if error:  # at last; a later file has it all
        say(f"error: {error}")
    failed = _counts(files)[FAILED]
    if failed and len(jobs) > 1:
        say(f"{failed} of {len(jobs)} files failed")
    if failed and len(jobs) == 1:
        return NOTHING_DONE
    return SOME_FAILED if failed or error else 0


def _counts(files: list[dict[str, Any]]) -> dict[str, int]:
    statuses = Counter(about["status"] for about in files)
    return {status: statuses[status] for status in (DONE, KEPT, FAILED)}


def in_words(kinds: Counter[str]) -> str:
    """Return how many files of each kind there are: ``"3 .max, 1 without a suffix"``."""
    kinds = Counter(kinds)
    bare = kinds.pop("", 0)
    words = [f"{count} {suffix}" for suffix, count in sorted(kinds.items())]
    return ", ".join(words + [f"{bare} without a suffix"] * (bare > 0))


def write_json(path: Path, content: Any) -> None:
    """Write a file of JSON.

    Raises InputError: it cannot be written.
    """
    with replacing(path) as temporary:
        temporary.write_text(json.dumps(content, indent=2) + "\n", encoding="utf-8")
