# SPDX-License-Identifier: GPL-3.0-or-later
"""A process of its own for a file: a crash of Blender, or a run without end, is a line of words.

The standard input of such a process is a pipe. It ends when the process at the other end is gone,
for whatever reason, or closes it: that is how it is told to end (`interruption.end_with_input`).
"""

import contextlib
import os
import signal
import subprocess
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from ....solver.console.output import remove_left_behind

CRASHING = (".usd", ".usda", ".usdc", ".usdz", ".abc", ".fbx")
"""formats whose importers trust the file, and crash Blender where it is broken"""
PATIENCE = 10.0
"""seconds in which a process tidies up before it is killed"""
_FROM_OUTSIDE = [getattr(signal, n, None) for n in ("SIGKILL", "SIGTERM", "SIGINT", "SIGHUP")]
_VARIABLES = (
    *("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"),
    *("VECLIB_MAXIMUM_THREADS", "TI_CPU_MAX_NUM_THREADS", "QD_CPU_MAX_NUM_THREADS"),
)


def thread_variables(count: int | None) -> dict[str, str]:
    """Return what in a process's environment keeps its numerical libraries to so many threads.

    Nothing for None. Cycles has a setting of its own.
    """
    return dict.fromkeys(_VARIABLES, str(count)) if count else {}


def run_child(
    command: list[str], timeout: float | None, outputs: Iterable[Path], **how: Any
) -> tuple[int, str]:
    """Run a process to its end, and remove what it has left unfinished of its outputs.

    `timeout`: seconds, or None. `how`: for `subprocess.Popen`. Returns its exit code; and in words,
    if it has crashed or takes too long, that it does.
    """
    process = subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        start_new_session=True,  # Ctrl-C is for us, with whom it ends
        creationflags=getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0),
        **how,
    )
    words = ""
    try:
        process.wait(timeout)
    except subprocess.TimeoutExpired:
        words = f"takes longer than {timeout:g} seconds (--timeout)"
    assert process.stdin
    process.stdin.close()
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(PATIENCE)
    process.kill()
    code = process.wait()
    for path in outputs:
        remove_left_behind(path)
    return code, words or _crash(code)


def _crash(code: int) -> str:
    """Return in words that a process has ended by a signal; nothing if it has not."""
    number = code - 128 if 128 < code < 160 else -code  # some launchers add it to 128
    if os.name != "nt" and number > 0:
        name = signal.strsignal(number) or f"signal {number}"
        if number in _FROM_OUTSIDE:
            return f"was ended from outside ({name})"
        return f"crashes Blender ({name}); export it again"
    return f"crashes Blender (exit code {code:#x}); export it again" if abs(code) > 255 else ""
