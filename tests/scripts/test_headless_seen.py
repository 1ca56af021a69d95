# SPDX-License-Identifier: GPL-3.0-or-later
"""What is seen is taken with ``--with-modifiers``: modifiers applied, texts as meshes."""

import numpy as np
import pytest
from headless import headless_ok, make_blend, run_to_blend

MAKE = """
import sys, bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_cube_add()
bpy.context.object.modifiers.new("Subdivision", "SUBSURF").levels = 3
bpy.ops.mesh.primitive_monkey_add(location=(4, 0, 0))
bpy.context.object.parent = bpy.data.objects["Cube"]
bpy.ops.object.text_add(location=(0, 3, 0))
bpy.context.object.data.extrude = 0.1
bpy.ops.mesh.primitive_uv_sphere_add()
bpy.context.object.name = "Cutter"
bpy.context.object.hide_render = True
cut = bpy.data.objects["Suzanne"].modifiers.new("Cut", "BOOLEAN")
cut.object, cut.show_viewport = bpy.context.object, False
bpy.ops.mesh.primitive_uv_sphere_add()
bpy.context.object.name = "In Tools"
tools = bpy.data.collections.new("Tools")
tools.hide_render = True
bpy.context.scene.collection.children.link(tools)
bpy.context.collection.objects.unlink(bpy.context.object)
tools.objects.link(bpy.data.objects["In Tools"])
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1])
"""
FAST = ("--device", "numpy", "--max-iterations", 20, "--together", "parts")


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    return make_blend(MAKE, tmp_path_factory.mktemp("seen") / "seen.blend")


def run(source, folder, *options):
    return run_to_blend(source, folder, *FAST, *options)


def test_what_is_seen_is_taken_in_place_of_the_meshes(source, tmp_path):
    report, found = run(source, tmp_path, "--with-modifiers")
    assert report["settings"]["with_modifiers"] is True
    counts = {entry["name"]: entry["vertices"] for entry in report["objects"]}
    assert set(counts) == {"Cube", "Suzanne", "Text"}
    assert counts["Cube"] == 386 and counts["Suzanne"] == 507 and counts["Text"] > 20
    ball = np.asarray(found["Cube"][0])
    assert len(ball) == 386
    sizes = np.abs(ball).max(axis=1)  # of a ball from 0.58 to 1, of a cube all alike
    assert sizes.min() > 0.8 * sizes.max(), "the ball has not become cubic"


def test_without_it_the_meshes_below_are_taken(source, tmp_path):
    report, _ = run(source, tmp_path)
    counts = {entry["name"]: entry["vertices"] for entry in report["objects"]}
    assert counts == {"Cube": 8, "Suzanne": 507}


def test_what_is_not_rendered_is_left_out(source, tmp_path):
    """As what a Boolean modifier cuts with; the reports of both tests above do not have it."""
    done = headless_ok(source, *FAST, "--no-render", "--report", "report.json", cwd=tmp_path)
    for name in ("Cutter", "In Tools"):
        assert f'"{name}" is left out: it is hidden, is not rendered or has no faces' in done.stderr
