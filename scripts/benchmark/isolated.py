# SPDX-License-Identifier: GPL-3.0-or-later
"""Call a function in a process of its own, so that its memory and its start are its own too."""

import importlib
import json
import subprocess
import sys
import tempfile
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
ROOT = SCRIPTS.parent

_ANSWER = (
    "import sys; sys.path[:0] = sys.argv[1:3];"
    "from benchmark.isolated import answer; answer(*sys.argv[3:])"
)


def call(module, function, **arguments):
    """Return ``benchmark.<module>.<function>(**arguments)``; both ways only what JSON can hold.

    Raises
    ------
    RuntimeError
        The function failed; the message has the end of what it wrote to standard error.
    """
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder, "answer.json")
        names = [str(SCRIPTS), str(ROOT), module, function, str(target)]
        process = subprocess.run(
            [sys.executable, "-c", _ANSWER, *names],
            input=json.dumps(arguments),
            capture_output=True,
            text=True,
            check=False,
        )
        if process.returncode != 0:
            end = process.stderr.strip()[-2000:]
            raise RuntimeError(f"{module}.{function}({arguments}) failed:\n{end}")
        return json.loads(target.read_text(encoding="utf-8"))


def answer(module, function, target):
    """Be the other process: take the arguments from standard input, write the answer."""
    arguments = json.load(sys.stdin)
    result = getattr(importlib.import_module(f"benchmark.{module}"), function)(**arguments)
    Path(target).write_text(json.dumps(result), encoding="utf-8")
