# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of many files: written anew after each, so that one that is interrupted has it too."""

import json
import time
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from .output import replacing

DONE, KEPT, FAILED = "done", "kept", "failed"
"""what became of a file; kept is what an earlier run has done"""


def write_batch(
    path: Path, head: dict[str, Any], total: int, begin: float, files: list[dict[str, Any]]
) -> None:
    """Write what is known now of so many files in total.

    `head`: what was known before the first. `begin`: of the batch, as `time.perf_counter`. `files`:
    all that have ended, each with its ``status``. Raises InputError, OSError: it cannot be written.
    """
    seconds = {"total": time.perf_counter() - begin}
    counts, unfinished = counts_of(files), total - len(files)
    about = {"counts": counts, "unfinished": unfinished, "files": files, "seconds": seconds}
    write_json(path, head | about)


def counts_of(files: Iterable[dict[str, Any]]) -> dict[str, int]:
    """Return how many files have each status."""
    statuses = Counter(about["status"] for about in files)
    return {status: statuses[status] for status in (DONE, KEPT, FAILED)}


def in_words(kinds: Counter[str]) -> str:
    """Return how many files of each kind there are: ``"3 .max, 1 without a suffix"``."""
    kinds = Counter(kinds)
    bare = kinds.pop("", 0)
    words = [f"{count} {suffix}" for suffix, count in sorted(kinds.items())]
    return ", ".join(words + [f"{bare} without a suffix"] * (bare > 0))


def write_json(path: Path, content: Any) -> None:
    """Write a file of JSON."""
    with replacing(path) as temporary:
        temporary.write_text(json.dumps(content, indent=2) + "\n", encoding="utf-8")
