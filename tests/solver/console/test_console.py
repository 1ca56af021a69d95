# SPDX-License-Identifier: GPL-3.0-or-later
"""What the command lines share: options, the lines of .obj files, and how they are told to end."""

import inspect
import os
import signal
import sys
import threading

import pytest

from solver import Run, run, stylize
from solver.console import interruption
from solver.console.method_options import FORMS
from solver.console.obj_lines import logical_lines, vertex_of
from solver.method import SETTINGS
from solver.styles import form_names, forms


def test_every_form_that_can_be_named_is_made():
    assert set(FORMS) == {"cube", "box", *forms.PLAIN, *forms.WITH_SIDES}
    assert {name.lower() for name in form_names.WITH_SIDES} == set(forms.WITH_SIDES)
    counts = {
        name: None if form is None else len(form.normals)
        for name in FORMS
        for form in [forms.named(name, 5, (1.0, 1.0, 2.0))]
    }
    assert counts["cube"] is None and counts["box"] == 6
    assert counts["prism"] == 7 and counts["pyramid"] == 6
    assert forms.named("box", 5, (1.0, 1.0, 1.0)) is None, "that is the cube"


@pytest.mark.parametrize("function", [Run, run, stylize])
def test_by_default_functions_do_what_the_options_say(function):
    given = inspect.signature(function).parameters
    for name in ("cubeness", "max_iterations", "tolerance"):
        assert name not in given or given[name].default == SETTINGS[name].default


@pytest.mark.parametrize(
    ("lines", "joined"),
    [
        ([b"v 1 2 \\", b"  3", b"f 1"], [b"v 1 2    3", b"f 1"]),
        ([b"f 1 \\", b"2 \\", b"3"], [b"f 1  2  3"]),
        ([b"f 1 2 3 \\"], [b"f 1 2 3  "]),
        ([b"v 1 2 3 # C:\\", b"f 1"], [b"v 1 2 3 # C:\\", b"f 1"]),
        ([b"# C:\\", b"v 1"], [b"# C:\\", b"v 1"]),
        ([b"usemtl parts\\", b"f 1"], [b"usemtl parts\\", b"f 1"]),
        (["o 表".encode("shift_jis"), b"v 1"], ["o 表".encode("shift_jis"), b"v 1"]),
        ([b"", b"\\", b"v 1"], [b"", b" v 1"]),
    ],
)
def test_numbers_are_continued_names_and_comments_are_not(lines, joined):
    assert list(logical_lines(lines)) == joined


def test_vertices_of_corners():
    corners = [b"1", b"4/2/3", b"4//3", b"-1/2", b"-4"]
    assert [vertex_of(corner, 4) for corner in corners] == [0, 3, 3, 3, 0]
    for corner in (b"0", b"-5", b"-9/1"):
        assert vertex_of(corner, 4) < 0
    assert vertex_of(b"5", 4) >= 4
    for corner in (b"", b"x", b"/1", b"1.5"):
        with pytest.raises(ValueError):
            vertex_of(corner, 4)


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
