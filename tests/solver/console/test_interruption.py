# SPDX-License-Identifier: GPL-3.0-or-later
"""How a process is told to end; test_library_refusals.py and test_headless_interrupted.py do so."""

import os
import signal
import sys
import threading

from solver.console import interruption


def test_it_can_begin_where_pipes_always_block(monkeypatch):
    """As on Windows with Python 3.11, where such pipes take the bytes of signals as well."""
    pipes, threads = [], []
    monkeypatch.setattr(sys, "platform", "win32")
    monkeypatch.delattr(os, "set_blocking")
    monkeypatch.setattr(signal, "set_wakeup_fd", pipes.append)
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    monkeypatch.setattr(threading.Thread, "start", lambda thread: threads.append(thread))
    interruption.end_on_signals("a program")
    assert os.write(pipes[0], b"a") == 1 and len(threads) == 1
