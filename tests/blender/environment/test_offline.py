# SPDX-License-Identifier: GPL-3.0-or-later
"""A whole session, from enabling to Restore, in which opening a socket is an error."""

import os
import subprocess
import sys
import textwrap

import bpy

CODE = """
    import socket
    def refuse(*_, **__):
        raise AssertionError("went online")
    for name in ("socket", "create_connection", "getaddrinfo", "socketpair"):
        setattr(socket, name, refuse)
    import bpy
    bpy.ops.preferences.addon_enable(module="bl_ext.user_default.cubic_craft")
    bpy.ops.mesh.primitive_monkey_add()
    for device in ("AUTO", "NUMPY"):
        done = bpy.ops.cubic_craft.cubify(max_iterations=3, refine="OFF", device=device)
        assert done == {"FINISHED"}
    assert bpy.ops.cubic_craft.auto_orient() == {"FINISHED"}
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    print("done without", flush=True)
    import os
    os._exit(0)  # Blender 4.2 crashes while it is freed
"""


def test_nothing_goes_online(extension):
    bpy.ops.wm.save_userpref()
    run = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(CODE)],
        capture_output=True,
        text=True,
        timeout=300,
        env=os.environ,
        check=False,
    )
    assert run.returncode == 0 and "done without" in run.stdout, run.stderr
    assert "went online" not in run.stderr
