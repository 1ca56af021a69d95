# SPDX-License-Identifier: GPL-3.0-or-later
"""Ctrl-C, or being told to end: one line, the exit code that shells expect, and nothing half-done.

Python runs signal handlers in the main thread, which cannot be told anything while it is in other
code: a factorization, or Blender that renders or exports. So our thread waits for the signal,
tidies up and ends the process at once. Nothing is lost by that: every file is written under a
temporary name (see `output`).
"""

import os
import signal
import sys
import threading
from collections.abc import Callable

from .output import remove_temporaries

_WORDS = {signal.SIGINT: "interrupted", signal.SIGTERM: "told to end"}
_CLEAN_LINE = b"\r\x1b[2K"
"""for terminals: erase the line of the progress"""


def end_on_signals(program: str, terminal: Callable[[], int] = lambda: 2) -> None:
    """From now on end with the exit code 128 + number on SIGINT (so 130 on Ctrl-C) and SIGTERM.

    `program`: its name in the line that says so. `terminal`: gives the file descriptor for that
    line.
    """
    arrivals, departures = os.pipe()
    if sys.platform != "win32":  # there it is not asked for, and Python 3.11 cannot do it
        os.set_blocking(departures, False)
    signal.set_wakeup_fd(departures)
    for number in _WORDS:
        if signal.getsignal(number) != signal.SIG_IGN:  # as shells have it for background jobs
            # It does nothing itself, but without a handler there is no byte for the thread.
            signal.signal(number, lambda *_: None)
    threading.Thread(
        target=_wait_for_signal, args=(arrivals, program, terminal), daemon=True
    ).start()


def _wait_for_signal(arrivals: int, program: str, terminal: Callable[[], int]) -> None:
    while True:
        number = os.read(arrivals, 1)[0]
        if number in _WORDS:
            break
    line = f"{program}: {_WORDS[signal.Signals(number)]}\n".encode()
    remove_temporaries()
    last_words = os.dup(terminal())
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # what goes on meanwhile says no more
    os.write(last_words, _CLEAN_LINE + line if os.isatty(last_words) else line)
    os._exit(128 + number)
