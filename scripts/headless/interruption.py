"""Ctrl-C, or being told to end: one line, the exit code that shells expect, and nothing half-done.

Python runs signal handlers in the main thread, which cannot be told anything while Blender renders
or exports. So a thread of ours waits for the signal, tidies up and ends the process at once.
Nothing is lost by that: every file is written under a temporary name (see `output_files`).
"""

import os
import signal
import threading

from .output_files import remove_temporaries
from .quiet import terminal

__all__ = ("end_on_signals",)

_WORDS = {signal.SIGINT: "interrupted", signal.SIGTERM: "told to end"}


def end_on_signals(program: str) -> None:
    """From now on end with the exit code 128 + number on SIGINT (so 130 on Ctrl-C) and SIGTERM."""
    arrivals, departures = os.pipe()
    os.set_blocking(departures, False)
    signal.set_wakeup_fd(departures)
    for number in _WORDS:
        if signal.getsignal(number) != signal.SIG_IGN:  # as shells have it for background jobs
            # It does nothing itself, but without a handler there is no byte for the thread.
            signal.signal(number, lambda *_: None)
    threading.Thread(target=_wait, args=(arrivals, program), daemon=True).start()


def _wait(arrivals: int, program: str) -> None:
    while True:
        number = os.read(arrivals, 1)[0]
        if number in _WORDS:
            break
    remove_temporaries()
    os.write(terminal(), f"{program}: {_WORDS[signal.Signals(number)]}\n".encode())
    os._exit(128 + number)
