# SPDX-License-Identifier: GPL-3.0-or-later
"""Without SciPy the extension can be enabled, and says what is missing; it never goes online."""

import os
import subprocess
import sys
import textwrap

import bpy
import pytest

CODE = """
    import sys
    sys.path[:0] = {folders}
    for name in {missing}:
        sys.modules[name] = None  # makes every import of it fail
    {first}
    import bpy
    bpy.ops.preferences.addon_enable(module="bl_ext.user_default.cubic_craft")
    bpy.ops.mesh.primitive_monkey_add()
    {then}
    import os
    sys.stdout.flush()
    os._exit(0)  # Blender 4.2 crashes while it is freed
"""
QUICK = "max_iterations=3, refine='OFF', keep_apart=False"


def run(missing, then, folders=(), first=""):
    """Run code in a fresh bpy that has the installed extension, with folders of other packages.

    `first`: what is run before bpy is imported.
    """
    first, then = (textwrap.indent(textwrap.dedent(x), "    ").strip() for x in (first, then))
    code = CODE.format(missing=missing, first=first, then=then, folders=list(folders))
    return subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code)],
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


BROKEN = {
    "wholly": {"__init__.py": "raise ImportError('DLL load failed.\\nMore of it')"},
    "in a part": {"__init__.py": "", "sparse.py": "raise ValueError('numpy.dtype size changed')"},
}


@pytest.mark.parametrize("how", BROKEN)
def test_a_broken_scipy_is_named_and_changes_nothing(tmp_path, how):
    """As another extension may bring one; the buttons are then disabled, and say the same."""
    package = tmp_path / "scipy"
    package.mkdir()
    for name, code in BROKEN[how].items():
        (package / name).write_text(code)
    done = run(
        [],
        """
        mesh = bpy.context.object.data
        before = [tuple(v.co) for v in mesh.vertices]
        for name in ("auto_orient", "cubify", "cubify", "live"):
            try:
                print(getattr(bpy.ops.cubic_craft, name)())
            except RuntimeError as error:
                print(name, str(error).strip().splitlines()[0])
        print([tuple(v.co) for v in mesh.vertices] == before, len(mesh.attributes))
        """,
        [str(tmp_path)],
    )
    *lines, last = done.stdout.splitlines()[-5:]
    reason = "DLL load failed" if how == "wholly" else "numpy.dtype size changed"
    assert len(lines) == 4, done.stdout + done.stderr
    for line in lines:
        assert f"CubicCraft needs SciPy, which does not work here ({reason}): remove or" in line
        assert f"the extension that brought {tmp_path}" in line
    assert "poll()" in lines[-1]
    assert last.startswith("True"), last
    assert "Traceback" not in done.stdout + done.stderr


def test_without_an_engine_and_cholespy_numpy_and_scipy_take_over():
    done = run(["taichi", "quadrants", "cholespy"], f"bpy.ops.cubic_craft.cubify({QUICK})")
    assert done.returncode == 0, done.stderr
    assert "on numpy" in done.stdout and " 3 iterations" in done.stdout


def test_enabling_imports_neither_scipy_nor_an_engine():
    done = run([], "print({'scipy', 'taichi', 'quadrants', 'cholespy'} & set(sys.modules))")
    assert done.stdout.splitlines()[-1] == "set()"


OFFLINE = """
    import socket
    def refuse(*_, **__):
        raise AssertionError("went online")
    for name in ("socket", "create_connection", "getaddrinfo", "socketpair"):
        setattr(socket, name, refuse)
"""


def test_nothing_goes_online():
    """In a whole session, from enabling to Restore, in which opening a socket is an error."""
    done = run(
        [],
        f"""
        for device in ("AUTO", "NUMPY"):
            assert bpy.ops.cubic_craft.cubify({QUICK}, device=device) == {{"FINISHED"}}
        assert bpy.ops.cubic_craft.auto_orient() == {{"FINISHED"}}
        assert bpy.ops.cubic_craft.restore() == {{"FINISHED"}}
        print("done without")
        """,
        first=OFFLINE,
    )
    assert done.returncode == 0 and "done without" in done.stdout, done.stderr
    assert "went online" not in done.stderr
