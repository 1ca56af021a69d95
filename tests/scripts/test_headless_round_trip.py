# SPDX-License-Identifier: GPL-3.0-or-later
"""A saved mesh has the vertices of the input: as many, in the same order, in the same space."""

import json

import numpy as np
import pytest
from headless import headless_ok, read_files
from make_inputs import FACES, POSITIONS, TINY

REST = POSITIONS * TINY
LOOSE = [0, 5, 11]
ROUND_TRIPS = (".ply", ".usd", ".usda", ".usdc", ".usdz", ".abc", ".blend")
COMMON = ("--device", "numpy", "--max-iterations", 30, "--no-render")
FAST = (*COMMON, "--paper")
"""without a finer copy, on which the place of vertices in a file does not depend"""


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
        *("awkward.blend", "--cubeness", 0.0, *FAST),
        *("--save-mesh", "again.blend", "--report", "again.json"),
        cwd=folder,
    )
    files.append(folder / "again.blend")
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
    form["capture_strength"] = None
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


@pytest.mark.parametrize(
    ("third", "names"),
    [("f 5 3 9", ["two"]), ("", ["second", "third"])],
    ids=["shared vertices", "own vertices"],
)
def test_objects_of_an_obj_keep_their_place_in_the_file(tmp_path, third, names):
    """The second object comes before the first one has a face; loose vertices lie between."""
    source = tmp_path / "two.obj"
    source.write_text(TWO_OBJECTS.format(third=third), encoding="utf-8")
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
    faces = {tuple(face) for face in obj_rows(tmp_path / "out.obj", "f")}
    assert faces == {("5", "7", "8"), ("2", "3", "4")} | ({("5", "3", "9")} if third else set())


TETRAHEDRON = np.array([[0, 0, 0], [4.125, 0, 0], [0, 4.125, 0], [0, 0, 4.125]])
FAR_AWAY = np.array([512345.25, 5412345.5, 321.75])
"""where a house is in the coordinates of its country, in metres"""


def tetrahedron_obj(path, place):
    """Write a tetrahedron at a place, and a loose vertex at the origin."""
    rows = [f"v {x!r} {y!r} {z!r}" for x, y, z in (TETRAHEDRON + place).tolist()]
    faces = ["f 1 3 2", "f 1 2 4", "f 2 3 4", "f 3 1 4"]
    path.write_text("\n".join([*rows, *faces, "v 0 0 0"]) + "\n")


def test_what_lies_far_away_is_not_rounded(tmp_path):
    found = {}
    for name, place in (("near", np.zeros(3)), ("far", FAR_AWAY)):
        tetrahedron_obj(tmp_path / f"{name}.obj", place)
        box = [(place - 0.1).tolist(), (place + 0.1).tolist()]
        pose = [{"box": box, "translate": [0.5, 0, 0], "rotate": [0, 9, 0]}]
        (tmp_path / "pose.json").write_text(json.dumps(pose))
        outputs = ("--handles", "pose.json", "--save-mesh", f"{name}_cubic.obj")
        headless_ok(f"{name}.obj", "--orientation", 20, 30, 0, *FAST, *outputs, cwd=tmp_path)
        rows = obj_rows(tmp_path / f"{name}_cubic.obj", "v")
        assert max(len(word) for row in rows for word in row) < 20
        found[name] = np.array(rows, float)[:4] - place
    np.testing.assert_allclose(found["far"], found["near"], rtol=0.0, atol=1e-4)
    assert np.abs(found["far"] - TETRAHEDRON).max() > 0.5


def test_what_32_bits_cannot_hold_is_said(tmp_path):
    tetrahedron_obj(tmp_path / "far.obj", FAR_AWAY)
    process = headless_ok("far.obj", *FAST, "--save-mesh", "moved.ply", cwd=tmp_path)
    (line,) = (line for line in process.stderr.splitlines() if "32 bits" in line)
    assert line.startswith("moved.ply: lies at the origin") and "512347 5412348 0 " in line
    header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
    header += (
        "property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header"
    )
    rows = [" ".join(map(repr, row)) for row in (TETRAHEDRON + FAR_AWAY).tolist()]
    faces = ["3 0 2 1", "3 0 1 3", "3 1 2 3", "3 2 0 3"]
    (tmp_path / "far.ply").write_text("\n".join([header, *rows, *faces]) + "\n")
    process = headless_ok("far.ply", *FAST, "--save-mesh", "result.ply", cwd=tmp_path)
    assert "far.ply: lies 5.41e+06 from its origin" in process.stderr
    assert "rounds coordinates to 0.5; move it to the origin" in process.stderr


def test_vertices_that_gltf_had_to_split_are_joined(inputs, tmp_path):
    arguments = ("--cubeness", 0.0, *FAST, "--save-mesh", "joined.obj")
    headless_ok(inputs / "awkward.glb", *arguments, cwd=tmp_path)
    positions = obj_positions(tmp_path / "joined.obj")
    assert len(np.unique(positions, axis=0)) == len(positions)
