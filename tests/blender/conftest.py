# SPDX-License-Identifier: GPL-3.0-or-later
"""The tests in bpy run against the extension as a user has it: built and installed from the zip."""

import importlib
import os
import sys
import tempfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
NAME = "bl_ext.user_default.cubic_craft"

# Before bpy is imported: an empty user folder, so that no setting or extension of the user matters.
_user_folder = tempfile.TemporaryDirectory(prefix="cubic_craft_tests_")
os.environ["BLENDER_USER_RESOURCES"] = _user_folder.name

import bpy  # noqa: E402
from scene import select  # noqa: E402

pytest.register_assert_rewrite("live_steps")  # what fails there is then explained as in a test


@pytest.fixture(scope="session")
def archive():
    """Return the path of the built extension: what CUBIC_CRAFT_ZIP says, or one built now."""
    given = os.environ.get("CUBIC_CRAFT_ZIP")
    if given:
        return Path(given).resolve()
    sys.path.insert(0, str(ROOT / "scripts"))
    from build_extension import build

    path = Path(_user_folder.name) / "built" / "cubic_craft.zip"
    build(path)
    return path


@pytest.fixture(scope="session", autouse=True)
def extension(archive):
    """Install and enable the built extension; return its package."""
    done = bpy.ops.extensions.package_install_files(
        filepath=str(archive), repo="user_default", enable_on_install=True
    )
    assert done == {"FINISHED"}
    module = importlib.import_module(NAME)
    assert _user_folder.name in module.__file__
    return module


@pytest.fixture(autouse=True)
def empty_file(extension):
    """Start each test with an empty file; the extension stays enabled."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)


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
    """Let a tick end after one phase of the solver: else a fast machine does all in the first."""
    monkeypatch.setattr(f"{live.__name__}.session.SLICE", 0.0)


@pytest.fixture
def begin(live):
    """Return a function that begins Live on objects, the first with these settings."""

    def start(*objects, **settings):
        for name, value in settings.items():
            setattr(objects[0].cubic_craft, name, value)
        select(*objects)
        return live.begin(bpy.context, list(objects))

    return start


def pytest_unconfigure(config):
    """Leave Blender 4.2 without freeing it, which crashes; see `leave` in headless_render.py."""
    if bpy.app.version < (4, 3) and hasattr(config, "exit_status_of_session"):
        _user_folder.cleanup()
        sys.stdout.flush()
        os._exit(config.exit_status_of_session)


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session, exitstatus):
    """Keep the result for `pytest_unconfigure`."""
    session.config.exit_status_of_session = int(exitstatus)
