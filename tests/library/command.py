# SPDX-License-Identifier: GPL-3.0-or-later
"""Run the installed command ``cubic-craft``: in a process of its own or, mostly, in this one."""

import contextlib
import dataclasses
import io
import subprocess
import sys
from pathlib import Path

from cubic_craft import ProxyOptions, stylize
from cubic_craft.command_line.program import run

COMMAND = Path(sys.executable).with_name("cubic-craft")
QUICK = ("--device", "numpy", "--refine", "off", "--tolerance", "0.01")
"""as the arguments that `quick` gives to the library"""


def quick(V, F, cubeness=0.4, **options):
    """Return the Result that the command writes with the options `QUICK`."""
    of_proxy = [field.name for field in dataclasses.fields(ProxyOptions) if field.name in options]
    given = {name: options.pop(name) for name in of_proxy}
    proxy = ProxyOptions(**{"refine": False, **given})
    options = {"crispness": 0.9, "keep_rotation": True, "tolerance": 0.01, **options}
    return stylize(V, F, cubeness, device="numpy", proxy=proxy, **options)


def in_this_process(arguments, folder):
    """Run what the command runs, without the second that a process takes to import SciPy."""
    code = 0
    with (
        contextlib.chdir(folder),
        contextlib.redirect_stdout(io.StringIO()) as out,
        contextlib.redirect_stderr(io.StringIO()) as errors,
    ):
        try:
            code = run([str(word) for word in arguments])
        except SystemExit as leaving:
            code = leaving.code or 0
    return subprocess.CompletedProcess(arguments, code, out.getvalue(), errors.getvalue())


def in_a_process(arguments, folder):
    """Run the command as a user does."""
    words = [COMMAND, *map(str, arguments)]
    return subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)


def cubic_craft(*arguments, folder, run=in_this_process):
    """Run the command in a folder; it must succeed and say nothing on standard output.

    Returns
    -------
    list of str
        The lines on standard error.
    """
    done = run(arguments, folder)
    assert done.returncode == 0, done.stderr
    assert not done.stdout
    return done.stderr.splitlines()


def refused(*arguments, folder, run=in_this_process):
    """Run the command, which must refuse with one line, and return the line."""
    before = sorted(folder.rglob("*"))
    done = run(arguments, folder)
    lines = done.stderr.splitlines()
    assert (done.returncode, len(lines), done.stdout) == (2, 1, ""), done.stderr
    assert lines[0].startswith("cubic-craft: error: ")
    assert sorted(folder.rglob("*")) == before, "a file was left behind"
    return lines[0]
