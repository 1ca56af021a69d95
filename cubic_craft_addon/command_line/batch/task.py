# SPDX-License-Identifier: GPL-3.0-or-later
"""Do one file of a batch in a process of its own, unless it is done already.

Its settings are the first line of the standard input of the process.
"""

import contextlib
import errno
import hashlib
import json
import os
import re
import signal
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any, NamedTuple

from ....solver.console.errors import InputError
from ....solver.console.report import DONE, FAILED, KEPT
from ....solver.console.temporary import remove_left_behind
from ...environment.lock import BusyError, Lock
from ..process.watched_process import Limits, finish, start, thread_variables
from ..trust.places import is_inside, refuse_special
from .plan import Job

REFUSED = 2
"""exit code for an input that cannot be used"""
_ERROR = re.compile(r"^(?:headless_render\.py|cubic_craft): error: (.*)$", re.MULTILINE)
"""what `main` says of an input, whichever program has called it"""
ASKED_EVERY = 0.2
"""seconds, whether a file is free that another process is at work on"""
FROM_OUTSIDE = [getattr(signal, n, None) for n in ("SIGKILL", "SIGTERM", "SIGINT", "SIGHUP")]


class Batch(NamedTuple):
    """What the files of a batch share."""

    command: list[str]
    """what starts the script"""
    threads: int | None
    """of the processor for each file; None for all"""
    settings: str
    """from `plan.settings_of`"""
    decides: str
    """from `plan.decisive`"""
    is_forced: bool
    """to do also what is done already"""
    limits: Limits = Limits()
    """of each file"""


def do(job: Job, batch: Batch) -> dict[str, Any]:
    """Do a file, or wait while another process does it, as one of a batch that runs twice.

    Returns ``status``; of a file that failed ``error``, one line, and if that is the fault of the
    file and not of the machine ``refused``; else ``seconds`` and ``report``; and if it was begun
    ``words``, what its process wrote to standard error, and ``peak_gb``.
    """
    try:
        refuse_special(job.path)
        if job.folder is not None and not is_inside(job.path, job.folder):
            raise InputError("is a link that leads out of the folder; give what it leads to")
        key = key_of(job.path, batch.decides)
        lock = _lock(job.record)
        try:
            return _do(job, batch, key)
        finally:
            lock.release()
    except InputError as error:
        message = str(error).removeprefix(f"{job.path}: ")
        return {"status": FAILED, "error": message, "refused": True}
    except OSError as error:
        return {"status": FAILED, "error": f"{error.strerror or error}: {error.filename}"}


def _lock(path: Path) -> Lock:
    while True:
        try:
            return Lock(path)
        except BusyError:
            time.sleep(ASKED_EVERY)


def _do(job: Job, batch: Batch, key: str) -> dict[str, Any]:
    report = {} if batch.is_forced else _report(job, key)
    if report:
        return _success(KEPT, report)
    code, words, exceeded, peak = _run(job, batch, key)
    report = _report(job, key)
    if report and not code and not exceeded:
        return _success(DONE, report) | {"words": words}
    refused = {"refused": True} if exceeded or code == REFUSED else {}
    why = exceeded or _why_failed(job, code, words)
    return {"status": FAILED, "error": why, **refused, "peak_gb": peak, "words": words}


def key_of(source: Path, decides: str) -> str:
    """Return a digest of all that decides about the results: content, options and version.

    Of files that the source refers to (materials, textures, buffers) nothing is in it.
    """
    if not source.is_file() and source.exists():  # to read a pipe would never end
        raise OSError(errno.EINVAL, "is not a regular file", str(source))
    with source.open("rb") as file:
        content = hashlib.file_digest(file, "sha256").hexdigest()
    return hashlib.sha256(f"{content} {decides}".encode()).hexdigest()


def _success(status: str, report: dict[str, Any]) -> dict[str, Any]:
    about = {"seconds": report["seconds"]["total"], "peak_gb": report["peak_gb"]}
    return {"status": status, **about, "report": report}


def _report(job: Job, key: str) -> dict[str, Any]:
    """Return the report of a run with this key; nothing if outputs have changed."""
    try:
        if job.record.is_symlink() or not job.record.is_file():
            return {}
        report = json.loads(job.record.read_text(encoding="utf-8"))
        made = report.pop("made")
        sizes = {path.name: path.stat().st_size for path in job.outputs}
        return report if made == {"for": key, "sizes": sizes} else {}
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return {}  # there is none, or it is not one of ours, or of another version


def _run(job: Job, batch: Batch, key: str) -> tuple[int, str, str, float | None]:
    """Run the process to its end.

    Returns its exit code, what it wrote to standard error, the limit that it has exceeded, and the
    most gigabytes of memory that it had.
    """
    job.record.unlink(missing_ok=True)  # from now on the outputs may be others than it says
    limit = [f"--threads={batch.threads}"] if batch.threads else []
    with tempfile.TemporaryFile() as words:
        process = start(
            [*batch.command, *job.arguments, *limit, f"--worker={key}"],
            stdout=subprocess.DEVNULL,
            stderr=words,
            env=os.environ | thread_variables(batch.threads),
        )
        with contextlib.suppress(OSError):  # what ends at once says itself why
            process.stdin.write(f"{batch.settings}\n".encode())
        exceeded, peak = finish(process, batch.limits)
        for path in (*job.outputs, job.record):
            remove_left_behind(path)
        words.seek(0)
        return process.returncode, words.read().decode(errors="replace"), exceeded, peak


def _why_failed(job: Job, code: int, words: str) -> str:
    """Say in one line why a process has failed."""
    if not code:
        return "its results are not those that its process has written"
    if code < 0:
        name = signal.strsignal(-code) or f"signal {-code}"
        return f"{'was ended from outside' if -code in FROM_OUTSIDE else 'crashed'} ({name})"
    if said := _ERROR.search(words):
        return said[1].removeprefix(f"{job.path}: ")
    return f"ended with exit code {code}: {(words.strip() or 'without a word').splitlines()[-1]}"
