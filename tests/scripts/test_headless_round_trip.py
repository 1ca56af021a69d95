# SPDX-License-Identifier: GPL-3.0-or-later
"""A saved mesh has the vertices of the input: as many, in the same order, in the same space."""

import json

import numpy as np
import pytest
from headless import headless_ok, make_blend, read_files
from make_inputs import FACES, POSITIONS, TINY

REST = POSITIONS * TINY
LOOSE = [0, 5, 11]
ROUND_TRIPS = (".ply", ".usd", ".usda", ".usdc", ".usdz", ".abc", ".blend")
COMMON = ("--device", "numpy", "--max-iterations", 30, "--no-render")
FAST = (*COMMON, "--paper")
"""without a finer copy, on which the place of vertices in a file does not depend"""
BALL = """
import sys, bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3)
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1])
"""
SCULPT = """
import sys, bpy
bpy.ops.wm.open_mainfile(filepath={source!r})
mesh = bpy.data.meshes[0]
for vertex in mesh.vertices[:5]:
    vertex.co.x += 0.25
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1])
"""


@pytest.fixture(scope="module")
def results(inputs, tmp_path_factory):
    """Folder of results, and {path: content} of all mesh files as Blender reads them."""
    folder = tmp_path_factory.mktemp("results")
    files = []
    for suffix in ROUND_TRIPS:
        source, target = inputs / f"awkward{suffix}", folder / f"awkward{suffix}"
        headless_ok(source, "--cubeness", 0.5, *FAST, "--save-mesh", target, cwd=folder)
        files += [source, target]
    headless_ok(
        *(inputs / "awkward.obj", "--cubeness", 0.0, 0.5, *COMMON, "--max-iterations", 5),
        *("--save-mesh", "awkward.obj", "--report", "report.json"),
        cwd=folder,
    )
    headless_ok(
        *(inputs / "awkward.usdc", "--cubeness", 0.5, *FAST, "--save-mesh", "from_usd.obj"),
        cwd=folder,
    )
    headless_ok(
        *("awkward.blend", "--cubeness", 0.0, *FAST),
        *("--save-mesh", "again.blend", "--report", "again.json"),
        cwd=folder,
    )
    headless_ok(
        *(inputs / "awkward.blend", "--object", "twin", "--pin", "pinned", "--cubeness", 0.5),
        *(*FAST, "--save-mesh", "pinned.abc"),
        cwd=folder,
    )
    files += [folder / "from_usd.obj", folder / "again.blend", folder / "pinned.abc"]
    return folder, dict(zip(files, read_files(*files, folder=folder), strict=True))


def obj_rows(path, keyword):
    """Rows of numbers or words of an .obj, as they stand in the text."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return [line.split()[1:] for line in lines if line.startswith(f"{keyword} ")]


def obj_positions(path):
    return np.array(obj_rows(path, "v"), np.float64).astype(np.float32)


def test_every_cubeness_gets_its_file(results):
    folder, _ = results
    assert {path.name for path in folder.glob("*.obj")} == {
        "awkward_0.0.obj",
        "awkward_0.5.obj",
        "from_usd.obj",
    }


def test_obj_without_cubeness_comes_back_as_it_was(results):
    """The mesh is 1e-5 small: six decimals would lose it, and the importer loses loose vertices."""
    folder, _ = results
    found = obj_positions(folder / "awkward_0.0.obj")
    np.testing.assert_allclose(found, REST, rtol=0.0, atol=1e-9 * float(TINY) * 9)
    np.testing.assert_array_equal(found[LOOSE], REST[LOOSE])


def test_obj_keeps_faces_and_uvs(inputs, results):
    folder, _ = results
    before, after = inputs / "awkward.obj", folder / "awkward_0.5.obj"
    uvs_before, uvs_after = obj_rows(before, "vt"), obj_rows(after, "vt")
    faces_before, faces_after = obj_rows(before, "f"), obj_rows(after, "f")
    assert len(faces_after) == len(FACES)
    for face_before, face_after in zip(faces_before, faces_after, strict=True):
        for corner_before, corner_after in zip(face_before, face_after, strict=True):
            vertex_before, uv_before = map(int, corner_before.split("/"))
            vertex_after, uv_after = map(int, corner_after.split("/"))
            assert vertex_after == vertex_before
            np.testing.assert_allclose(
                np.array(uvs_after[uv_after - 1], float),
                np.array(uvs_before[uv_before - 1], float),
                atol=1e-6,
            )


def test_obj_is_cubic(results):
    folder, _ = results
    moved = np.abs(obj_positions(folder / "awkward_0.5.obj") - REST).max(axis=1)
    assert moved.max() > 0.01 * TINY
    assert not moved[LOOSE].any()


@pytest.mark.parametrize("suffix", ROUND_TRIPS)
def test_format_keeps_vertices_faces_and_place(inputs, results, suffix):
    """Reordered vertices would show: the faces name them, and each has its own place."""
    folder, read = results
    before = read[inputs / f"awkward{suffix}"]
    after = read[folder / f"awkward{suffix}"]
    assert after.keys() == before.keys()
    for name, (rest, faces, place, modifiers) in before.items():
        result, faces_after, place_after, modifiers_after = after[name]
        assert faces_after == faces
        assert modifiers_after == modifiers
        np.testing.assert_allclose(place_after, place, rtol=1e-5, atol=1e-6)
        np.testing.assert_array_equal(result[LOOSE], rest[LOOSE])
        extent = np.ptp(rest[1:5], axis=0).max()
        assert 0.1 * extent < np.abs(result - rest).max() < 1.5 * extent


def test_formats_agree(results):
    """The same mesh with the same transform gives the same vertices, whatever the format."""
    folder, read = results
    wanted = next(iter(read[folder / "awkward.usdc"].values()))[0]
    for suffix in (".usd", ".usda", ".usdz", ".abc", ".blend"):
        for found, *_ in read[folder / f"awkward{suffix}"].values():
            np.testing.assert_allclose(found, wanted, atol=1e-5 * float(TINY))


def test_obj_of_a_placed_object_is_in_world_space(results):
    """Without an .obj as input the file gets Blender's usual axes, and the object's transform."""
    folder, read = results
    positions, _, place, _ = next(iter(read[folder / "awkward.usdc"].values()))
    world = positions.astype(np.float64) @ place[:3, :3].T + place[:3, 3]
    y_up = world[:, [0, 2, 1]] * [1, 1, -1]
    np.testing.assert_allclose(obj_positions(folder / "from_usd.obj"), y_up, atol=1e-6)


def test_report(results):
    folder, _ = results
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    assert {"cubic_craft", "blender", "python", "taichi", "quadrants"} <= report["versions"].keys()
    assert report["device"] == "numpy"
    assert report["seconds"].keys() == {"load", "write", "render", "total"}
    (entry,) = report["objects"]
    runs = entry.pop("runs")
    what = {"name": "awkward", "vertices": 12, "triangles": 14, "components": 1}
    assert entry == what | {"solved_with": []}
    by_default = {
        "crispness": 0.9,
        "solidity": 0.3,
        "detail_strength": 1.0,
        "keep_pose": "on",
        "detail": 0.05,
        "keep_apart": "on",
    }
    by_default |= {"together": "selection", "refine": "auto", "rotation": "keep"}
    off = {"symmetry": "auto", "floor": "auto", "hold_rest": "on", "with_modifiers": False}
    form = {"form": "cube", "form_sides": 6, "form_weights": [1.0, 1.0, 1.0], "region": []}
    form |= {"form_directions": "", "orientation": [0.0] * 3, "map": "", "detail_map": ""}
    assert report["settings"] == {**form, "space": "world", **by_default, **off}
    assert [run["cubeness"] for run in runs] == [0.0, 0.5]
    for run in runs:
        names = {"cubeness", "iterations", "converged", "crossings", "energy", "seconds"}
        assert run.keys() == names and run["crossings"] in (None, 0)
        assert run["energy"].keys() == {"total", "arap", "cubic"}
        assert run["seconds"].keys() == {"setup", "solve", "compile"}
    assert runs[0]["converged"] is True
    assert runs[1]["energy"]["cubic"] > 0.0


def test_saved_blend_can_be_cubified_again_from_its_original(results):
    folder, read = results
    for positions, *_ in read[folder / "again.blend"].values():
        np.testing.assert_allclose(positions, REST, rtol=0.0, atol=1e-9 * float(TINY) * 9)


def test_shared_mesh_is_solved_once(results):
    folder, _ = results
    report = json.loads((folder / "again.json").read_text(encoding="utf-8"))
    assert len(report["objects"]) == 1


def test_pinned_vertices_stay(results):
    folder, read = results
    ((name, (positions, *_)),) = read[folder / "pinned.abc"].items()
    assert name == "twin"
    moved = np.abs(positions - REST).max(axis=1)
    assert not moved[[1, 2, 3, 4]].any()
    assert moved.max() > 0.01 * TINY


TWO_OBJECTS = """\
v 9 9 9
o first
v 0 0 0
v 1 0 0
v 0 1 0
o second
v 5 0 0
v 8 8 8
v 6 0 0
v 5 1.5 0
f -4 -2 -1
o third
v 0 0 1.5
f 2 \\
3 4
{third}
"""


IN_ORDER = TWO_OBJECTS.replace("second", "later").replace(
    "f 2 \\\n3 4", "v 1 1 1\nv 0 1 0\nf -3 -2 -1"
)


@pytest.mark.parametrize(
    ("text", "names"),
    [
        (TWO_OBJECTS.format(third="f 5 3 9"), ["two"]),
        (TWO_OBJECTS.format(third=""), ["two"]),
        (IN_ORDER.format(third="").replace("third", "be fore"), ["be fore", "later"]),
    ],
    ids=["shared vertices", "another order", "own vertices"],
)
def test_objects_of_an_obj_keep_their_place_in_the_file(tmp_path, text, names):
    """The second object comes before the first one has a face; loose vertices lie between."""
    source = tmp_path / "two.obj"
    source.write_text(text, encoding="utf-8")
    headless_ok(
        *(source, "--cubeness", 0.0, *FAST),
        *("--save-mesh", "out.obj", "--report", "out.json"),
        cwd=tmp_path,
    )
    report = json.loads((tmp_path / "out.json").read_text(encoding="utf-8"))
    assert sorted(entry["name"] for entry in report["objects"]) == names
    np.testing.assert_allclose(
        obj_positions(tmp_path / "out.obj"), obj_positions(source), atol=1e-6
    )
    written = [" ".join(row) for row in obj_rows(tmp_path / "out.obj", "o")]
    assert written == names[::-1], "in the order of the file"
    faces = {tuple(face) for face in obj_rows(tmp_path / "out.obj", "f")}
    wanted = {("5", "7", "8"), ("9", "10", "11") if len(names) > 1 else ("2", "3", "4")}
    assert faces == wanted | ({("5", "3", "9")} if "f 5 3 9" in text else set())


def test_what_is_rounded_as_it_lies_far_away_is_said(tmp_path):
    rows = [
        "v 512345.25 5412345.5 321.75",
        "v 512349 5412345.5 321.75",
        "v 512345.25 5412349 321.75",
    ]
    (tmp_path / "far.obj").write_text("\n".join([*rows, "f 1 2 3", ""]))
    process = headless_ok("far.obj", *FAST, "--save-mesh", "result.ply", cwd=tmp_path)
    assert "far.obj: lies 5.41e+06 from its origin" in process.stderr
    assert "rounds coordinates to 0.5; move it to the origin" in process.stderr


def test_vertices_that_gltf_had_to_split_are_joined(inputs, tmp_path):
    arguments = ("--cubeness", 0.0, *FAST, "--save-mesh", "joined.obj")
    headless_ok(inputs / "awkward.glb", *arguments, cwd=tmp_path)
    positions = obj_positions(tmp_path / "joined.obj")
    assert len(np.unique(positions, axis=0)) == len(positions)


def test_what_was_sculpted_on_a_result_is_in_all_files(tmp_path):
    """Whichever format: the same cubeness again gives the sculpted shape, another keeps strokes."""
    fast = ("--device", "numpy", "--max-iterations", 20, "--refine", "off", "--no-render")
    ball = make_blend(BALL, tmp_path / "ball.blend")
    headless_ok(ball, *fast, "--cubeness", 0.4, "--save-mesh", "cubic.blend", cwd=tmp_path)
    sculpt = SCULPT.format(source=str(tmp_path / "cubic.blend"))
    sculpted = make_blend(sculpt, tmp_path / "sculpted.blend")
    for name, cubeness in (("again.blend", 0.4), ("again.ply", 0.4), ("softer.ply", 0.1)):
        options = ("--cubeness", cubeness, "--save-mesh", name)
        headless_ok(sculpted, *fast, *options, cwd=tmp_path)
    names = ("cubic.blend", "sculpted.blend", "again.blend", "again.ply", "softer.ply")
    read = read_files(*(tmp_path / name for name in names), folder=tmp_path)
    cubic, expected, *again, softer = (next(iter(found.values()))[0] for found in read)
    for points in again:
        np.testing.assert_allclose(points, expected, atol=1e-5)
    assert np.abs(expected - cubic).max() > 0.2
    assert np.abs(softer - expected).max() > 0.01
