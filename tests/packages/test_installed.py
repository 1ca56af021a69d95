# SPDX-License-Identifier: GPL-3.0-or-later
"""The built Linux packages in Blenders that have nothing of our code on the Python path, offline.

``CUBIC_CRAFT_BARE_PYTHONS``: Pythons with bpy and what it needs; ``CUBIC_CRAFT_PACKAGES``: the
folder of the packages. ``make test-package`` makes both.
"""

import os
import subprocess
from pathlib import Path

import pytest

PYTHONS = os.environ.get("CUBIC_CRAFT_BARE_PYTHONS", "").split()
PACKAGES = Path(os.environ.get("CUBIC_CRAFT_PACKAGES", "."))
SESSION = Path(__file__).with_name("session.py")

pytestmark = pytest.mark.skipif(not PYTHONS, reason="no bare Pythons are named")


@pytest.fixture(scope="module")
def no_network():
    """Return the command that runs another without network; empty where this is not allowed.

    The session itself refuses to open sockets in any case; this is for the processes it starts.
    """
    command = ["unshare", "--map-root-user", "--net"]
    try:
        allowed = subprocess.run([*command, "true"], capture_output=True, check=False)
    except FileNotFoundError:  # not on Linux
        return []
    return command if allowed.returncode == 0 else []


def package_for(python):
    """Return the package for a Python."""
    code = "import sys; print('%d.%d' % sys.version_info[:2])"
    version = subprocess.run([python, "-c", code], capture_output=True, text=True, check=True)
    (found,) = PACKAGES.glob(f"cubic_craft-*-linux_x64-python{version.stdout.strip()}.zip")
    return found.resolve()


def run_session(python, what, package, folder, prefix=()):
    """Run a part of the session in a Blender whose user folder is `folder`."""
    return subprocess.run(
        [*prefix, python, "-I", SESSION, what, package],
        capture_output=True,
        text=True,
        timeout=600,
        env={**os.environ, "BLENDER_USER_RESOURCES": str(folder), "HOME": str(folder)},
        check=False,
    )


@pytest.mark.parametrize("python", PYTHONS)
def test_from_installing_to_removing(tmp_path, python, no_network):
    for name in ("taichi", "quadrants", "scipy", "cholespy", "pyamg"):
        code = f"import importlib.util as u, sys; sys.exit(u.find_spec('{name}') is not None)"
        assert subprocess.run([python, "-I", "-c", code], check=False).returncode == 0, name
    for what in ("first", "later"):
        done = run_session(python, what, package_for(python), tmp_path, no_network)
        print(done.stdout)
        assert "done in" in done.stdout, done.stdout + done.stderr
        assert "Traceback" not in done.stderr, done.stderr
