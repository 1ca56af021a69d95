# SPDX-License-Identifier: GPL-3.0-or-later
"""The installed command reads, stylizes and writes, and keeps what a format can hold."""

import dataclasses

import meshio
import numpy as np
import pytest
from command import QUICK, cubic_craft, quick
from scipy.spatial.transform import Rotation

from cubic_craft import PAPER, ProxyOptions, stylize
from cubic_craft.styles import forms
from scripts.benchmark.shapes import blob

V, F = blob(2)
ENDINGS = (".obj", ".ply", ".stl", ".off", ".vtk", ".vtu")
HOUSE = np.array(
    [
        *[(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 1.5), (2, 0, 1.5), (2, 2, 1.5)],
        *[(0, 2, 1.5), (1, 0, 2.5), (1, 2, 2.5), (7, 7, 7)],
    ],
    float,
)
"""with a vertex that is loose"""
HOUSE_FACES = [
    ("quad", np.array([[3, 2, 1, 0], [1, 2, 6, 5], [3, 0, 4, 7]], np.int32)),
    ("polygon", np.array([[0, 1, 5, 8, 4], [2, 3, 7, 9, 6]], np.int32)),
    ("quad", np.array([[5, 6, 9, 8], [7, 4, 8, 9]], np.int32)),
]


def save(path, points=V, cells=None, **data):
    meshio.Mesh(points, cells or [("triangle", F.astype(np.int32))], **data).write(path)
    return path.name


@pytest.mark.parametrize("ending", ENDINGS)
def test_each_format_gives_what_the_library_gives(ending, tmp_path):
    name = save(tmp_path / f"blob{ending}")
    lines = cubic_craft(name, f"cubic{ending}", *QUICK, folder=tmp_path)
    assert len(lines) == 1
    assert "162 vertices, 320 faces" in lines[0] and ", converged, energy" in lines[0]
    before, after = meshio.read(tmp_path / name), meshio.read(tmp_path / f"cubic{ending}")
    result = quick(before.points, before.cells[0].data)
    assert np.allclose(after.points, result.positions, atol=1e-6 if ending == ".stl" else 1e-8)
    assert np.array_equal(after.cells[0].data, before.cells[0].data)


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
    name = save(tmp_path / "blob.vtk")
    lines = cubic_craft(name, "cubic.vtk", *QUICK, *given.split(), folder=tmp_path)
    result = quick(V, F, **OPTIONS[given])
    assert ("NOT converged" in lines[0]) == ("--max-iterations" in given)
    points = meshio.read(tmp_path / "cubic.vtk").points
    assert np.allclose(points, result.positions, atol=1e-9)
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


def test_the_default_device_uses_what_is_installed(tmp_path):
    options = ("--refine", "off", "--tolerance", "1e-5")
    line = cubic_craft(save(tmp_path / "blob.ply"), "cubic.ply", *options, folder=tmp_path)[0]
    assert f", {stylize(V, F, 0.4, proxy=PAPER).device}, " in line
    points = meshio.read(tmp_path / "cubic.ply").points
    assert np.allclose(points, quick(V, F, tolerance=1e-5).positions, atol=1e-3)


@pytest.mark.parametrize("ending", [".obj", ".ply", ".vtu"])
def test_quads_polygons_and_loose_vertices_stay(ending, tmp_path):
    name = save(tmp_path / f"house{ending}", HOUSE, HOUSE_FACES)
    lines = cubic_craft(name, f"cubic{ending}", "--cubeness", "2", *QUICK, folder=tmp_path)
    assert len(lines) == 1 and "11 vertices, 7 faces" in lines[0]
    mesh = meshio.read(tmp_path / f"cubic{ending}")
    assert [block.type for block in mesh.cells] == [kind for kind, _ in HOUSE_FACES]
    for block, (_, faces) in zip(mesh.cells, HOUSE_FACES, strict=True):
        assert np.array_equal(block.data, faces)
    assert np.array_equal(mesh.points[10], HOUSE[10])
    assert np.abs(mesh.points[:10] - HOUSE[:10]).max() > 0.01


@pytest.mark.parametrize("ending", [".stl", ".off"])
def test_formats_of_triangles_say_so(ending, tmp_path):
    name = save(tmp_path / "house.ply", HOUSE, HOUSE_FACES)
    lines = cubic_craft(name, f"cubic{ending}", *QUICK, folder=tmp_path)
    assert lines[1:] == ["cubic-craft: note: 7 faces become 16 triangles"]
    assert len(meshio.read(tmp_path / f"cubic{ending}").cells_dict["triangle"]) == 16


@pytest.mark.parametrize("ending", [".vtk", ".vtu"])
def test_data_of_points_and_cells_stays(ending, tmp_path):
    random = np.random.default_rng(3)
    point_data = {"heat": random.normal(size=len(V)), "uv": random.normal(size=(len(V), 2))}
    cell_data = {"material": [np.arange(len(F))]}
    name = save(tmp_path / f"blob{ending}", point_data=point_data, cell_data=cell_data)
    assert len(cubic_craft(name, f"cubic{ending}", *QUICK, folder=tmp_path)) == 1
    mesh = meshio.read(tmp_path / f"cubic{ending}")
    for key, values in point_data.items():
        assert np.array_equal(mesh.point_data[key], values)
    assert np.array_equal(mesh.cell_data["material"][0], cell_data["material"][0])


def test_what_a_format_cannot_hold_is_named(tmp_path):
    point_data = {"heat": np.arange(len(V), dtype=float), "uv": np.ones((len(V), 2))}
    cell_data = {"material": [np.arange(len(F))]}
    name = save(tmp_path / "blob.vtk", point_data=point_data, cell_data=cell_data)
    notes = cubic_craft(name, "cubic.ply", *QUICK, folder=tmp_path)[1:]
    assert notes == [
        "cubic-craft: note: left out of the cells: material",
        "cubic-craft: note: left out of the points: uv",
    ]
    mesh = meshio.read(tmp_path / "cubic.ply")
    assert np.array_equal(mesh.point_data["heat"], point_data["heat"])
    assert "heat, uv" in cubic_craft(name, "cubic.off", *QUICK, folder=tmp_path)[-1]


def test_normals_are_rotated(tmp_path):
    normals = V / np.linalg.norm(V, axis=1, keepdims=True)
    columns = dict(zip(("nx", "ny", "nz"), normals.T.astype(np.float32), strict=True))
    cubic_craft(
        save(tmp_path / "blob.ply", point_data=columns), "cubic.ply", *QUICK, folder=tmp_path
    )
    cubic_craft(
        save(tmp_path / "blob.vtu", point_data={"Normals": normals}),
        *("cubic.vtu", *QUICK),
        folder=tmp_path,
    )
    turned = np.einsum("nij,nj->ni", quick(V, F).rotations, normals)
    assert np.abs(turned - normals).max() > 0.1
    ply = meshio.read(tmp_path / "cubic.ply").point_data
    assert np.allclose(np.stack([ply[name] for name in columns], axis=1), turned, atol=1e-6)
    assert np.allclose(meshio.read(tmp_path / "cubic.vtu").point_data["Normals"], turned)
