# SPDX-License-Identifier: GPL-3.0-or-later
"""Do one file of a batch in a process of its own, unless it is done already.

That process is given the command line of the batch, and which file it shall do.
"""

import hashlib
import json
import os
import re
import subprocess
import tempfile
from argparse import Namespace
from pathlib import Path
from typing import Any, NamedTuple

from ....solver.console.report import DONE, FAILED, KEPT
from ..options.arguments import options_for
from ..process.child import run_child, thread_variables
from ..process.output_files import written

_ERROR = re.compile(r"^(?:headless_render\.py|cubic_craft): error: (.*)$", re.MULTILINE)
"""what `main` says of an input, whichever program has called it"""
_NOT_DECISIVE = {
    *("inputs", "input", "output", "report", "output_folder", "recursive", "only", "jobs", "force"),
    *("timeout", "threads", "child", "worker", "verbose", "paper", "handles"),
}
_FILES = ("handles_file", "form_object", "capture")
"""whose content decides, not the name"""


class Job(NamedTuple):
    """One file of a batch."""

    path: Path
    """absolute"""
    name: str
    """of its results, without suffix"""
    outputs: tuple[Path, ...]
    """all that is written"""
    record: Path
    """the report of the run that has made them"""


def job_of(options: Namespace, name: str, path: Path) -> Job:
    """Return the job that makes results of a name."""
    own = options_for(options, name, path)
    return Job(path, name, tuple(written(own)), own.report)


def key_of(source: Path, options: Namespace, version: str) -> str:
    """Return a digest of all that decides about the results: content, options and version.

    Of files that the source refers to (materials, textures, buffers) nothing is in it.
    """
    told = {n: str(x) for n, x in vars(options).items() if n not in (*_NOT_DECISIVE, *_FILES)}
    files = [path for name in _FILES if (path := getattr(options, name))]
    digests = [hashlib.sha256(path.read_bytes()).hexdigest() for path in (source, *files)]
    return hashlib.sha256(json.dumps([version, told, digests]).encode()).hexdigest()


def do(job: Job, options: Namespace, command: list[str], key: str) -> dict[str, Any]:
    """Do a file.

    `options`: of the batch. `command`: what starts a process for it. Returns ``status``; of a file
    that failed ``error``, one line, else ``seconds`` and ``report``; and if it was begun ``words``,
    what its process wrote to standard error.
    """
    report = {} if options.force else _report(job, key)
    if report:
        return {"status": KEPT, "seconds": report["seconds"]["total"], "report": report}
    job.record.unlink(missing_ok=True)  # from now on the outputs may be others than it says
    with tempfile.TemporaryFile() as words:
        code, why = run_child(
            command,
            options.timeout,
            (*job.outputs, job.record),
            stdout=subprocess.DEVNULL,
            stderr=words,
            env=os.environ | thread_variables(options.threads),
        )
        words.seek(0)
        said = words.read().decode(errors="replace")
    report = _report(job, key)
    if report and not code:
        about = {"seconds": report["seconds"]["total"], "report": report}
        return {"status": DONE, **about, "words": said}
    return {"status": FAILED, "error": why or _why_failed(job, code, said), "words": said}


def _report(job: Job, key: str) -> dict[str, Any]:
    """Return the report of a run with this key; nothing if outputs have changed."""
    try:
        report = json.loads(job.record.read_text(encoding="utf-8"))
        made = report.pop("made")
        sizes = {path.name: path.stat().st_size for path in job.outputs}
        return report if made == {"for": key, "sizes": sizes} else {}
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return {}  # there is none, or it is not one of ours, or of another version


def _why_failed(job: Job, code: int, words: str) -> str:
    if not code:
        return "its results are not those that its process has written"
    if said := _ERROR.search(words):
        return said[1].removeprefix(f"{job.path}: ")
    return f"ended with exit code {code}: {(words.strip() or 'without a word').splitlines()[-1]}"
