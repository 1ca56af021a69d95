# SPDX-License-Identifier: GPL-3.0-or-later
"""The installed command reads, stylizes and writes, and keeps what a format can hold."""

import dataclasses

import numpy as np
import pytest
import trimesh
from command import QUICK, cubic_craft, in_a_process, quick
from scipy.spatial.distance import cdist
from scipy.spatial.transform import Rotation

from cubic_craft import PAPER, CubicCraftError, ProxyOptions, stylize
from cubic_craft.command_line import arguments, style
from cubic_craft.mesh.polygons import triangulate
from cubic_craft.styles import forms
from tests.icospheres import blob

V, F = blob(2)
ENDINGS = (".obj", ".ply", ".stl", ".off", ".glb")
HOUSE = """\
v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 1.5\nv 2 0 1.5\nv 2 2 1.5\nv 0 2 1.5\nv 1 0 2.5\nv 1 2 2.5
v 7 7 7
f 4 3 2 1\nf 2 3 7 6\nf 4 1 5 8\nf 1 2 6 9 5\nf 3 4 8 10 7\nf 6 7 10 9\nf 8 5 9 10
"""
"""with a vertex that is loose"""


def save(path, points=V, **data):
    trimesh.Trimesh(points, F, process=False, **data).export(path)
    return path.name


def load(path):
    (mesh,) = trimesh.load_scene(path, process=False).geometry.values()
    return mesh


@pytest.mark.parametrize("ending", ENDINGS)
def test_each_format_gives_what_the_library_gives(ending, tmp_path):
    name = save(tmp_path / f"blob{ending}")
    lines = cubic_craft(name, f"cubic{ending}", *QUICK, folder=tmp_path)
    assert len(lines) == 1
    assert "162 vertices, 320 faces" in lines[0] and ", converged, energy" in lines[0]
    after = load(tmp_path / f"cubic{ending}")
    if ending == ".stl":  # whose corners are apart, and its vertices in another order
        nearest = cdist(after.vertices, quick(V, F).positions).min(axis=1)
        assert nearest.max() < 0.01
        return
    assert np.allclose(after.vertices, quick(V, F).positions, atol=1e-6)
    assert np.array_equal(after.faces, F)


IN_PAPER = dataclasses.asdict(PAPER)
OPTIONS = {
    "--cubeness 0.8": {"cubeness": 0.8},
    "--form octahedron": {"form": forms.octahedron()},
    "--form prism --form-sides 5": {"form": forms.prism(5)},
    "--form box --form-weights 1 1 0": {"form": forms.box([1, 1, 0])},
    "--crispness 1": {"crispness": 1.0},
    "--detail-strength 2": {"detail_strength": 2.0},
    "--solidity 1": {"solidity": 1.0},
    "--together off": {"together": False},
    "--refine auto --max-iterations 5": {"refine": True, "max_iterations": 5},
    "--rotation free": {"keep_rotation": False},
    "--paper": {**IN_PAPER, "crispness": 0.0, "keep_rotation": False},
    "--paper --rotation keep --solidity 0.5": {**IN_PAPER, "crispness": 0.0, "solidity": 0.5},
    "--max-iterations 3": {"max_iterations": 3},
    "--tolerance 0.0001": {"tolerance": 1e-4},
    "--orientation 10 20 30": {
        "orientation": (
            Rotation.from_euler("z", 30, degrees=True)
            * Rotation.from_euler("y", 20, degrees=True)
            * Rotation.from_euler("x", 10, degrees=True)
        )
        .inv()
        .as_matrix()
    },
}


@pytest.mark.parametrize("given", OPTIONS)
def test_options_are_those_of_the_library(given, tmp_path):
    name = save(tmp_path / "blob.obj")
    lines = cubic_craft(name, "cubic.obj", *QUICK, *given.split(), folder=tmp_path)
    result = quick(V, F, **OPTIONS[given])
    assert ("NOT converged" in lines[0]) == ("--max-iterations" in given)
    points = load(tmp_path / "cubic.obj").vertices
    # the file has rounded numbers: of a refined mesh, other vertices may be the opposite ones
    atol = 1e-4 if "refine" in given else 1e-5
    assert np.allclose(points, result.positions, atol=atol)
    is_other = np.abs(points - quick(V, F).positions).max() > 1e-4
    assert is_other == (given != "--together off"), "a blob has one part"


PROXIES = {
    "": ProxyOptions(),
    "--paper": PAPER,
    "--paper --keep-pose on --detail 0.1 --keep-apart on": dataclasses.replace(
        PAPER, keep_pose=True, detail=0.1, keep_apart=True
    ),
}
for option in dataclasses.fields(ProxyOptions):
    word, value = ("off", False) if option.default is True else ("0.2", 0.2)
    given = f"--{option.name.replace('_', '-')} {word}"
    PROXIES[given] = dataclasses.replace(ProxyOptions(), **{option.name: value})


@pytest.mark.parametrize("given", PROXIES)
def test_each_option_of_the_proxy_reaches_the_solver(given, monkeypatch):
    def watched(*_, proxy, **__):
        assert proxy == PROXIES[given]
        raise CubicCraftError("as far as this")

    monkeypatch.setattr(style, "stylize", watched)
    with pytest.raises(CubicCraftError, match="as far as this"):
        style.stylized(V, F, arguments.parse(["in.obj", "out.obj", *given.split()]))


def test_the_default_device_uses_what_is_installed(tmp_path):
    options = ("--refine", "off", "--tolerance", "1e-5")
    line = cubic_craft(save(tmp_path / "blob.ply"), "cubic.ply", *options, folder=tmp_path)[0]
    assert f", {stylize(V, F, 0.4, proxy=PAPER).device}, " in line
    points = load(tmp_path / "cubic.ply").vertices
    assert np.allclose(points, quick(V, F, tolerance=1e-5).positions, atol=1e-3)


def test_quads_polygons_and_loose_vertices_stay(tmp_path):
    (tmp_path / "house.obj").write_text(HOUSE)
    lines = cubic_craft("house.obj", "cubic.obj", "--cubeness", "2", *QUICK, folder=tmp_path)
    assert len(lines) == 1 and "11 vertices, 7 faces" in lines[0]
    text = (tmp_path / "cubic.obj").read_text()
    assert text.partition("f ")[2] == HOUSE.partition("f ")[2]
    assert "\nv 7 7 7\n" in text and "v 2 2 1.5" not in text


def test_quads_of_an_obj_have_one_side_each(tmp_path):
    """As in Blender: `triangulate`d, some would be folded along their diagonals."""
    sides = np.sort(F[:, [[1, 2], [2, 0], [0, 1]]], axis=2)
    edges, number = np.unique(sides.reshape(-1, 2), axis=0, return_inverse=True)
    middle, center = len(V) + number.reshape(F.shape), len(V) + len(edges) + np.arange(len(F))
    points = np.concatenate([V, V[edges].mean(axis=1), V[F].mean(axis=1)])
    points *= 1.0 + 0.05 * np.sin(7.0 * points @ [1.0, 2.0, 3.0])[:, None]  # no quad is flat
    quads = np.concatenate(
        [np.stack([F[:, i], middle[:, i - 1], center, middle[:, i - 2]], 1) for i in range(3)]
    )
    rows = [f"v {x!r} {y!r} {z!r}" for x, y, z in points.tolist()]
    rows += ["f " + " ".join(map(str, quad)) for quad in (quads + 1).tolist()]
    (tmp_path / "ball.obj").write_text("\n".join(rows) + "\n")
    cubic_craft("ball.obj", "cubic.ply", *QUICK, folder=tmp_path)
    made, wanted = load(tmp_path / "cubic.ply").vertices, quick(points, quads).positions
    folded = quick(points, triangulate(points, quads)).positions
    assert np.abs(made - wanted).max() < 1e-6 < 1e-3 < np.abs(made - folded).max()


def test_a_polygon_with_a_hole_in_it_passes_a_vertex_twice(tmp_path):
    ring = "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nv 1 1 0\nv 1 2 0\nv 2 2 0\nv 2 1 0\n"
    (tmp_path / "slit.obj").write_text(f"{ring}f 1 2 3 4 1 5 6 7 8 5\n")
    (line,) = cubic_craft("slit.obj", "cubic.obj", *QUICK, folder=tmp_path)
    assert "8 vertices, 1 faces" in line


@pytest.mark.parametrize("ending", [".stl", ".off"])
def test_formats_of_triangles_say_so(ending, tmp_path):
    (tmp_path / "house.obj").write_text(HOUSE)
    lines = cubic_craft("house.obj", f"cubic{ending}", *QUICK, folder=tmp_path)
    assert lines[1:] == ["cubic-craft: note: 7 faces become 16 triangles"]
    assert len(load(tmp_path / f"cubic{ending}").faces) == 16


def test_colors_stay_and_normals_are_rotated(tmp_path):
    colors = np.random.default_rng(1).integers(0, 255, (len(V), 4), np.uint8)
    normals = V / np.linalg.norm(V, axis=1, keepdims=True)
    name = save(tmp_path / "blob.ply", vertex_colors=colors, vertex_normals=normals)
    cubic_craft(name, "cubic.ply", *QUICK, folder=tmp_path)
    made = load(tmp_path / "cubic.ply")
    turned = np.einsum("nij,nj->ni", quick(V, F).rotations, normals)
    assert np.abs(turned - normals).max() > 0.1
    assert np.allclose(made.vertex_normals, turned, atol=1e-5)
    assert np.array_equal(made.visual.vertex_colors, colors)


def test_an_existing_output_is_replaced(tmp_path):
    name = save(tmp_path / "blob.ply")
    (tmp_path / "cubic.ply").write_text("old")
    cubic_craft(name, "cubic.ply", *QUICK, folder=tmp_path, run=in_a_process)
    assert len(load(tmp_path / "cubic.ply").vertices) == len(V)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["blob.ply", "cubic.ply"]
