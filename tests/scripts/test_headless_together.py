# SPDX-License-Identifier: GPL-3.0-or-later
"""All meshes of a file are solved as one, unless they are told apart."""

import numpy as np
import pytest
from headless import make_blend, run_to_blend

MAKE = """
import sys, bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
for name, x, size in (("Body", 0.0, 1.0), ("Hat", 1.05, 0.4), ("Far", 9.0, 1.0)):
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3, location=(x, 0.1, 0.2))
    bpy.context.object.name, bpy.context.object.scale = name, (size, size * 0.8, size * 0.7)
    bpy.context.object.rotation_euler.z = x
twin = bpy.data.objects.new("Twin", bpy.data.objects["Body"].data)
bpy.context.collection.objects.link(twin)
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1])
"""
MIRRORED = np.array([1, -1, 1], np.float32)
FAST = ("--device", "numpy", "--max-iterations", 20, "--refine", "off")


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    return make_blend(MAKE, tmp_path_factory.mktemp("together") / "dressed.blend")


def run(source, folder, *options):
    """Return the report and, by the name of the object, positions."""
    report, found = run_to_blend(source, folder, *FAST, *options)
    return report, {name: content[0] for name, content in found.items()}


def test_all_meshes_of_a_file_are_one(source, tmp_path):
    report, shapes = run(source, tmp_path, "--cubeness", 0.4)
    entries = {entry["name"]: entry for entry in report["objects"]}
    assert set(entries) == {"Body", "Hat", "Far"}, "the twin shares the mesh of the body"
    assert entries["Hat"]["solved_with"] == [name for name in entries if name != "Hat"]
    runs = [entry["runs"][0] for entry in entries.values()]
    assert runs[0] == runs[1] == runs[2]
    for entry in entries.values():
        assert (entry["vertices"], entry["components"]) == (162, 1)
    apart, alone = run(source, tmp_path, "--cubeness", 0.4, "--together", "parts")
    assert all(entry["solved_with"] == [] for entry in apart["objects"])
    assert apart["settings"]["together"] == "parts"
    assert len({entry["runs"][0]["energy"]["total"] for entry in apart["objects"]}) == 3
    assert np.abs(shapes["Hat"] - alone["Hat"]).max() > 1e-3
    np.testing.assert_array_equal(shapes["Body"], shapes["Twin"])


def in_order(V):
    return V[np.lexsort(V.T + np.float32(0))]


def test_symmetry_and_floor(source, tmp_path):
    """The far ball is turned about Z, and symmetric in its own axes."""
    report, shapes = run(
        source, tmp_path, "--symmetry", "y", "--floor", "on", "--together", "parts"
    )
    assert (report["settings"]["symmetry"], report["settings"]["floor"]) == ("y", "on")
    _, free = run(source, tmp_path, "--together", "parts")
    V = shapes["Far"]
    assert (in_order(V) == in_order(V * MIRRORED)).all()
    other = free["Far"]
    assert (in_order(other) != in_order(other * MIRRORED)).any()
    assert V[:, 2].min() == pytest.approx(-1.0, abs=1e-6)
    assert free["Far"][:, 2].min() != pytest.approx(-1.0, abs=1e-3)
