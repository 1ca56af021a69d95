# SPDX-License-Identifier: GPL-3.0-or-later
"""The tests in bpy run against the extension as a user has it: built and installed from the zip."""

import importlib
import itertools
from functools import partial
from types import SimpleNamespace

import pytest
from installed import archive, empty_file, extension, pytest_sessionfinish, pytest_unconfigure

import bpy  # isort: skip  # after `installed`, which gives it an empty user folder
from scene import QUICK, change_settings, select  # isort: skip

__all__ = (
    "archive",
    "begin",
    "empty_file",
    "extension",
    "follow",
    "live",
    "one_phase",
    "posed",
    "pytest_sessionfinish",
    "pytest_unconfigure",
    "reopen",
)

pytest.register_assert_rewrite("live_steps")  # what fails there is then explained as in a test


@pytest.fixture
def posed(extension):
    """Return `object_handles` of the installed extension."""
    module = f"{extension.__name__}.cubic_craft_addon.handles.pose"
    return importlib.import_module(module).object_handles


@pytest.fixture
def reopen(tmp_path):
    """Return a function that saves the file, opens it anew and returns the object of a name."""

    def save_and_open(name):
        path = str(tmp_path / "file.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        return bpy.data.objects[name]

    return save_and_open


@pytest.fixture
def part(extension):
    """Return a function that imports a module of the add-on."""
    return lambda name: importlib.import_module(f"{extension.__name__}.cubic_craft_addon.{name}")


@pytest.fixture
def live(extension):
    """Return the package of Live; what a test has left running is cancelled."""
    module = importlib.import_module(f"{extension.__name__}.cubic_craft_addon.live")
    yield module
    session = module.current()
    if session is not None:
        session.on(module.Event.CANCEL)


@pytest.fixture
def one_phase(live, monkeypatch):
    """Let a tick end after one phase of the solver: else a fast machine does all in the first.

    Each one looks for changes: else a fast machine does many before it sees that of a setting. What
    glides does so by the number of shapes that are shown: else a slow one shows others.
    """
    clock = SimpleNamespace(perf_counter=partial(next, itertools.count(step=1.0 / 30.0)))
    monkeypatch.setattr(f"{live.__name__}.live_mesh.time", clock)
    monkeypatch.setattr(f"{live.__name__}.session._CHECK_SHARE", float("inf"))
    for name in ("SLICE", "LONGEST"):
        monkeypatch.setattr(f"{live.__name__}.slices.{name}", 0.0)


@pytest.fixture
def begin(live):
    """Return a function that begins Live on objects, the first with these settings.

    As `scene.cubify`, it is quick unless the settings say otherwise.
    """

    def start(*objects, **settings):
        change_settings(objects[0], **{**QUICK, **settings})
        select(*objects)
        return live.begin(bpy.context, list(objects))

    return start


@pytest.fixture
def follow(live, begin, monkeypatch):
    """Return a function that begins Live with a follower; the exact run waits for no long pause."""
    monkeypatch.setattr(f"{live.__name__}.pace.LEAST_PAUSE", 0.05)

    def start(*objects, **settings):
        return begin(*objects, result="NEW_OBJECT", **{"cubeness": 0.5, **settings})

    return start
