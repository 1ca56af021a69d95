# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension as a user has it, built and installed from the zip: fixtures for a conftest.py."""

import functools
import importlib
import os
import sys
import tempfile
from pathlib import Path

import pytest

__all__ = ("archive", "empty_file", "extension", "pytest_sessionfinish", "pytest_unconfigure")

ROOT = Path(__file__).resolve().parents[3]
NAME = "bl_ext.user_default.cubic_craft"

# Before bpy is imported: an empty user folder, so that no setting or extension of the user matters.
_user_folder = tempfile.TemporaryDirectory(prefix="cubic_craft_tests_")
os.environ["BLENDER_USER_RESOURCES"] = _user_folder.name

import bpy  # noqa: E402


@pytest.fixture(scope="session")
def archive():
    """Return the path of the built extension: what CUBIC_CRAFT_ZIP says, or one built now."""
    given = os.environ.get("CUBIC_CRAFT_ZIP")
    return Path(given).resolve() if given else _built()


@pytest.fixture(scope="session", autouse=True)
def extension(archive):
    """Install and enable the built extension; return its package."""
    return _installed(archive)


@pytest.fixture(autouse=True)
def empty_file(extension):
    """Start each test with an empty file; the extension stays enabled."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)


# Each conftest.py has fixtures of its own, of which a process may run those of several.
@functools.cache
def _built():
    sys.path.insert(0, str(ROOT / "scripts"))
    from build_extension import build

    path = Path(_user_folder.name) / "built" / "cubic_craft.zip"
    build(path)
    return path


@functools.cache
def _installed(archive):
    done = bpy.ops.extensions.package_install_files(
        filepath=str(archive), repo="user_default", enable_on_install=True
    )
    assert done == {"FINISHED"}
    module = importlib.import_module(NAME)
    assert _user_folder.name in module.__file__
    return module


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
