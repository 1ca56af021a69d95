# SPDX-License-Identifier: GPL-3.0-or-later
"""Without SciPy the extension can be enabled, and says what is missing instead of failing."""

import os
import subprocess
import sys
import textwrap

import bpy
import pytest

CODE = """
    import sys
    for name in {missing}:
        sys.modules[name] = None  # makes every import of it fail
    import bpy
    bpy.ops.preferences.addon_enable(module="bl_ext.user_default.cubic_craft")
    bpy.ops.mesh.primitive_monkey_add()
    {then}
    import os
    sys.stdout.flush()
    os._exit(0)  # Blender 4.2 crashes while it is freed
"""


def run(missing, then):
    """Run code in a fresh bpy that has the installed extension."""
    code = textwrap.dedent(CODE.format(missing=missing, then=then))
    return subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        timeout=300,
        env={**os.environ, "BLENDER_USER_RESOURCES": os.environ["BLENDER_USER_RESOURCES"]},
    )


@pytest.fixture(autouse=True, scope="module")
def installed(extension):
    bpy.ops.wm.save_userpref()


def test_without_scipy_cubify_says_what_is_missing():
    done = run(["scipy"], "bpy.ops.cubic_craft.cubify()")
    assert "CubicCraft needs SciPy" in done.stderr + done.stdout
    assert "No module named" not in done.stderr + done.stdout


def test_without_taichi_numpy_takes_over():
    done = run(["taichi"], "bpy.ops.cubic_craft.cubify(max_iterations=3)")
    assert done.returncode == 0, done.stderr
    assert "on numpy" in done.stdout


def test_without_cholespy_scipy_factorises():
    done = run(["cholespy"], "bpy.ops.cubic_craft.cubify(max_iterations=3, keep_apart=False)")
    assert done.returncode == 0, done.stderr
    assert " 3 iterations" in done.stdout


def test_enabling_imports_neither_scipy_nor_taichi():
    done = run([], "print([m for m in ('scipy', 'taichi', 'cholespy') if m in sys.modules])")
    assert done.stdout.splitlines()[-1] == "[]"
