# SPDX-License-Identifier: GPL-3.0-or-later
"""A normal capture on the command line: the ball is that of another file."""

import numpy as np
import pytest
from headless import headless_ok, headless_refused, make_blend, run_to_blend

MAKE = """
import sys, bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4)
bpy.context.object.name = "Ball"
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1])
"""
BALL = """
import sys, bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5)
for vertex in bpy.context.object.data.vertices:
    vertex.co /= sum(abs(x) ** 8 for x in vertex.co) ** (1 / 8)
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1])
"""
FLAT = """
import sys, bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_plane_add()
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1])
"""
FAST = ("--device", "numpy", "--cubeness", 0)


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    return make_blend(MAKE, tmp_path_factory.mktemp("capture") / "ball.blend")


def filling(source, folder, *options):
    """Return the report, and how much of its bounding box each vertex reaches at most."""
    report, found = run_to_blend(source, folder, *FAST, *options)
    V = found["Ball"][0]
    return report, np.abs(V).max(axis=1).mean() / np.abs(V).max()


def test_a_ball_becomes_like_the_ball_of_the_file(source, tmp_path):
    capture = make_blend(BALL, tmp_path / "cushion.blend")
    report, round_one = filling(source, tmp_path)
    assert report["settings"]["capture_strength"] is None
    report, weak = filling(source, tmp_path, "--capture", capture)
    assert report["settings"]["capture_strength"] == 0.4
    _, strong = filling(source, tmp_path, "--capture", capture, "--capture-strength", 2)
    assert round_one < weak < strong and strong > 0.9


def test_a_file_without_a_ball_is_refused(source, tmp_path):
    flat = make_blend(FLAT, tmp_path / "flat.blend")
    headless_refused(
        *(source, "--capture", flat, "--no-render", "--report", "r.json"),
        words=['"flat" is not a normal capture', "do not surround"],
        cwd=tmp_path,
    )
    headless_ok(
        *(source, "--capture", flat, "--capture-strength", 0, "--no-render"),
        *("--report", "r.json", *FAST),
        cwd=tmp_path,
    )
