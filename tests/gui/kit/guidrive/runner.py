# SPDX-License-Identifier: GPL-3.0-or-later
"""The start and the end of a test: run(test) is the last line of each test script."""

import faulthandler
import os
import pathlib
import sys
import time
import traceback

import addon_utils
import bpy

from .pictures import save_screen
from .screen import smooth_viewport
from .waiting import counts, start_counting, wait_until

python_errors = []  # tracebacks of errors that Blender caught (in draw, modal, handlers, timers)

_SLEEP = 0.002  # seconds: with simulated events Blender never sleeps, and would take a whole core

_PAUSE = 0.1  # seconds; what is longer is no look of wait_until, and has so many turns at least:
_TURNS = 10  # a busy machine may take a second for one

_start = time.monotonic()


def log(*values):
    """Print the values with the time since the start."""
    print(f"[gui {time.monotonic() - _start:7.3f}]", *values, flush=True)


def run(test, timeout=1740.0):
    """Start the test, a generator function: passed when it ends, failed when it raises.

    It also fails when Blender has caught a Python error, after `timeout` seconds, or 30 seconds
    later with all stack traces if Blender hangs; keep the run script's -t (1800) above that.
    """
    faulthandler.dump_traceback_later(timeout + 30, exit=True)
    _quiet_preferences()
    start_counting()
    _keep_python_errors()
    steps = _after_first_draw(test)
    deadline = time.monotonic() + timeout
    end_of_pause, turns = 0.0, 0

    def turn():
        nonlocal end_of_pause, turns
        if turns > 0 or time.monotonic() < end_of_pause:
            turns -= 1
            time.sleep(_SLEEP)
            return 0.0
        try:
            pause = next(steps)
            if time.monotonic() > deadline:
                steps.throw(TimeoutError(f"the test ran longer than {timeout:g} s"))
        except StopIteration:
            _finish()
        except BaseException as error:  # whatever it is, the test has failed
            traceback.print_exc()
            _fail(repr(error))
        else:
            end_of_pause = time.monotonic() + (pause or 0.0)
            turns = _TURNS if (pause or 0.0) >= _PAUSE else 0
            return 0.0  # in the next turn
        return None

    bpy.app.timers.register(turn, persistent=True)


def _finish():
    """Quit Blender in the regular way, so that a crash in unregister() or at the exit shows."""
    if python_errors:
        _fail(f"{len(python_errors)} Python error(s) in Blender, see above")
    log(f"PASSED: {sum(os.times()[:4]):.1f} core-seconds, {counts['WINDOW']} views drawn")
    sys.stderr.flush()
    pathlib.Path(os.environ["GUIDRIVE_PASSED"]).touch()
    bpy.ops.wm.quit_blender()


def _fail(reason):
    """End Blender with a picture of the screen and exit code 1, or 3 after a Python error."""
    log(f"FAILED {reason}")
    sys.stderr.flush()
    try:
        save_screen("failed.png")
    finally:
        os._exit(3 if python_errors else 1)


def _after_first_draw(test):
    yield from wait_until(lambda: counts["WINDOW"] > 0, what="the first draw of the viewport")
    for module in list(bpy.context.preferences.addons.keys()):
        _, loaded = addon_utils.check(module)
        if module.startswith("bl_ext.") and not loaded:
            raise RuntimeError(f"the extension {module} could not be enabled, see above")
    yield from test()


def _quiet_preferences():
    """Switch off what gets in the way of a test."""
    preferences = bpy.context.preferences
    preferences.use_preferences_save = False
    preferences.view.show_splash = False
    preferences.view.show_tooltips = False
    preferences.view.smooth_view = 0
    preferences.view.use_save_prompt = False
    preferences.filepaths.use_auto_save_temporary_files = False
    smooth_viewport(False)


def _keep_python_errors():
    print_error = sys.excepthook

    def keep_error(error_type, error, trace):
        python_errors.append("".join(traceback.format_exception(error_type, error, trace)))
        print_error(error_type, error, trace)

    sys.excepthook = keep_error
