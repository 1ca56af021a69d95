"""Processes that do one file each, and end with the process that started them.

They share the reading end of a pipe as standard input. It ends when this process closes the other
end, or is gone for whatever reason: that is how they are told to end, on every system.
"""

import contextlib
import os
import signal
import subprocess
import sys
import threading
import time
from typing import Any

from ..threads import thread_variables

__all__ = ("Workers", "why_failed")

PATIENCE = 10.0
"""seconds in which a worker tidies up before it is killed"""
CRASHES = {
    getattr(signal, name)
    for name in ("SIGSEGV", "SIGABRT", "SIGBUS", "SIGILL", "SIGFPE", "SIGTRAP")
    if hasattr(signal, name)
}


class Workers:
    """Starts workers and knows those that run."""

    def __init__(self, command: list[str], threads: int | None) -> None:
        """Prepare.

        Parameters
        ----------
        command : what starts the script, to which its arguments are added
        threads : of the processor, for each worker; None for all
        """
        self._command = command
        self._environment = os.environ | (thread_variables(threads) if threads else {})
        self._input, self._lifeline = os.pipe()
        self._running: set[subprocess.Popen[str]] = set()
        self._starting = threading.Lock()
        self._is_ending = False

    def run(self, arguments: list[str]) -> tuple[int, str]:
        """Run one worker to its end; return its exit code and what it wrote to standard error."""
        with self._starting:
            process = subprocess.Popen(
                [*self._command, *arguments],
                stdin=self._input,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                env=self._environment,
                encoding="utf-8",
                errors="replace",
                **_apart(),
            )
            self._running.add(process)
        try:
            _, words = process.communicate()
        finally:
            self._running.discard(process)
        if self._is_ending:
            threading.Event().wait()  # nothing more is said of what does not fail by itself
        return process.returncode, words

    def end(self) -> None:
        """End all that run and wait until they are gone; later ones end by themselves."""
        with self._starting:  # or one that is being started would be left behind
            self._is_ending = True
            os.close(self._lifeline)
            running = list(self._running)
        deadline = time.monotonic() + PATIENCE
        while any(process.poll() is None for process in running) and time.monotonic() < deadline:
            time.sleep(0.02)
        for process in running:
            process.kill()
        for process in running:
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(PATIENCE)


def _apart() -> dict[str, Any]:
    """Keep Ctrl-C from the workers: it is for this process, which then ends them."""
    if sys.platform == "win32":
        return {"creationflags": subprocess.CREATE_NEW_PROCESS_GROUP}
    return {"start_new_session": True}


def why_failed(code: int, words: str, error_begin: str) -> str:
    """Say in one line why a worker has failed.

    Parameters
    ----------
    code : exit code, or minus the number of the signal that ended it
    words : what it wrote to standard error
    error_begin : how the script begins the line that says what is wrong
    """
    if code < 0:
        name = signal.strsignal(-code) or f"signal {-code}"
        return f"crashed ({name})" if -code in CRASHES else f"was ended from outside ({name})"
    lines = [line for line in words.splitlines() if line.strip()]
    for line in lines:
        if line.startswith(error_begin):
            return line.removeprefix(error_begin)
    last = lines[-1].strip() if lines else "without a word"
    return f"ended with exit code {code}: {last}"
