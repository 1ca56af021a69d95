# SPDX-License-Identifier: GPL-3.0-or-later
"""Scripts that run one after the other in one Blender, for tests that ask what they write and say.

To start Blender takes ten times as long as a run with a small mesh. Nothing of a script is
replaced: each runs its own `main`, or all of it if there is none, with standard output, standard
error and a folder of its own. What depends on a process of its own, such as signals and how it
ends, is no matter for this.
Run by itself, this file does what it is told, a line of JSON for each script, and answers each with
the exit code. It ends with its standard input.
"""

import atexit
import json
import os
import runpy
import subprocess
import sys
import tempfile
import threading
import traceback
from pathlib import Path

__all__ = ("SharedProcess",)


class SharedProcess:
    """A process that starts with the first script, and anew after one that has crashed it."""

    def __init__(self, patience) -> None:
        self._process, self._patience = None, patience  # seconds for each script

    def run(self, script, arguments, cwd):
        """Run a script with these arguments in a folder, and return the completed process."""
        if self._process is None:
            command = [sys.executable, __file__]
            pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
            self._process = subprocess.Popen(command, **pipes, text=True)
            atexit.register(self._process.communicate)  # closes its standard input, and waits
        with tempfile.TemporaryDirectory() as folder:
            files = [Path(folder) / name for name in ("stdout", "stderr")]
            for file in files:
                file.touch()
            job = [script, [str(word) for word in arguments], cwd, *files]
            self._process.stdin.write(json.dumps(job, default=str) + "\n")
            self._process.stdin.flush()
            alarm = threading.Timer(self._patience, self._process.kill)
            alarm.start()
            answer = self._process.stdout.readline()
            alarm.cancel()
            said = [file.read_text(encoding="utf-8") for file in files]
        if not answer:
            code, self._process = self._process.wait(), None
            raise AssertionError(f"{arguments} ended the process with {code}: {said[1]}")
        return subprocess.CompletedProcess(arguments, int(answer), *said)


def serve():
    """Run scripts until standard input ends."""
    answers = os.fdopen(os.dup(1), "w")
    for line in sys.stdin:
        print(run_once(*json.loads(line)), file=answers, flush=True)
    os._exit(0)  # Blender 4.2 crashes at its end


def run_once(script, arguments, cwd, *streams):
    """Run a script with files as its standard output and standard error; return its exit code."""
    kept = [os.dup(number) for number in (1, 2)]
    for number, name in enumerate(streams, 1):
        file = os.open(name, os.O_WRONLY)
        os.dup2(file, number)
        os.close(file)
    os.chdir(cwd)
    sys.argv = [script, *arguments]
    try:
        main = runpy.run_path(script).get("main")
        return (main() if main else None) or 0
    except BaseException:
        traceback.print_exc()
        return 1
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        for number, copy in enumerate(kept, 1):
            os.dup2(copy, number)
            os.close(copy)


if __name__ == "__main__":
    serve()
