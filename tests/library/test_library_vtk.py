# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces in legacy .vtk files, as VTK, PyVista and ParaView write them."""

import meshio
import numpy as np
import pytest
from command import QUICK, cubic_craft

from cubic_craft.command_line.mesh_files import read
from scripts.benchmark.shapes import blob

V, F = blob(1)
NORMALS = V / np.linalg.norm(V, axis=1, keepdims=True)


def numbers(values, kind, is_text):
    """Return an array as it stands in a file."""
    if is_text:
        return "\n".join(map(str, np.ravel(values).tolist())).encode() + b"\n"
    return np.asarray(values, np.dtype(kind).newbyteorder(">")).tobytes() + b"\n"


def polydata(version, is_text):
    """Return a file with a line, triangles, and all kinds of data."""

    def block(head, values, kind):
        return head.encode() + b"\n" + numbers(values, kind, is_text)

    kind = "ASCII" if is_text else "BINARY"
    begin = f"# vtk DataFile Version {version}\nby hand\n{kind}\nDATASET POLYDATA\n"
    parts = [begin.encode(), block(f"POINTS {len(V)} double", V, "f8")]
    for name, cells in (("LINES", np.array([[0, 1, 2]])), ("POLYGONS", F)):
        count = len(cells)
        if version < 5:
            rows = np.insert(cells, 0, 3, axis=1)
            parts.append(block(f"{name} {count} {4 * count}", rows, "i4"))
            continue
        offsets = np.arange(count + 1) * 3
        parts.append(block(f"{name} {count + 1} {3 * count}\nOFFSETS vtktypeint64", offsets, "i8"))
        parts.append(block("CONNECTIVITY vtktypeint64", cells, "i8"))
    parts += [
        block(
            f"CELL_DATA {len(F) + 1}\nSCALARS a%20name int\nLOOKUP_TABLE x", range(len(F) + 1), "i4"
        ),
        block("LOOKUP_TABLE x 2", [1.0] * 8 if is_text else [255] * 8, "u1"),
        block(f"POINT_DATA {len(V)}\nNORMALS Normals double", NORMALS, "f8"),
        block("TEXTURE_COORDINATES uv 2 float", V[:, :2], "f4"),
        b"METADATA\nCOMPONENT_NAMES\nu\nv\n\n",
        block(f"FIELD FieldData 1\nid 1 {len(V)} long", range(len(V)), "i8"),
    ]
    return b"".join(parts)


@pytest.mark.parametrize("version", [3.0, 4.2, 5.1])
@pytest.mark.parametrize("is_text", [True, False])
def test_surfaces_of_other_programs_are_read(version, is_text, tmp_path):
    (tmp_path / "a.vtk").write_bytes(polydata(version, is_text))
    file = read(tmp_path / "a.vtk")
    np.testing.assert_array_equal(file.surface.points, V)
    np.testing.assert_array_equal(file.surface.triangles, F)
    assert [(block.type, len(block.data)) for block in file.mesh.cells] == [
        *(("line", 2), ("triangle", len(F)))
    ]
    lines, triangles = file.mesh.cell_data["a name"]
    assert lines.tolist() == [0, 0] and triangles.tolist() == list(range(1, len(F) + 1))
    assert {name: data.shape for name, data in file.mesh.point_data.items()} == {
        **{"Normals": (len(V), 3), "uv": (len(V), 2), "id": (len(V),)}
    }


def test_data_is_written_again_and_normals_turn(tmp_path):
    (tmp_path / "a.vtk").write_bytes(polydata(5.1, is_text=False))
    cubic_craft("a.vtk", "b.vtk", "--cubeness", "1", *QUICK, folder=tmp_path)
    assert b"a%20name" in (tmp_path / "b.vtk").read_bytes()
    mesh = read(tmp_path / "b.vtk").mesh
    assert mesh.point_data["id"].tolist() == list(range(len(V)))
    assert np.linalg.norm(mesh.point_data["Normals"], axis=1) == pytest.approx(1.0)
    assert np.abs(mesh.point_data["Normals"] - NORMALS).max() > 0.01
    assert meshio.read(tmp_path / "b.vtk").cells_dict["triangle"].tolist() == F.tolist()


def test_strips_pixels_and_grids(tmp_path):
    points = "0 0 0 1 0 0 0 1 0 1 1 0 0 2 0\n"
    begin = f"# vtk DataFile Version 3.0\nx\nASCII\nDATASET %s\nPOINTS 5 float\n{points}"
    for name, data_set, cells in (
        ("strip", "POLYDATA", "TRIANGLE_STRIPS 1 6\n5 0 1 2 3 4\n"),
        ("pixel", "UNSTRUCTURED_GRID", "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n8\n"),
    ):
        (tmp_path / f"{name}.vtk").write_text(begin % data_set + cells)
    strip, pixel = (read(tmp_path / f"{name}.vtk").mesh.cells for name in ("strip", "pixel"))
    assert strip[0].data.tolist() == [[0, 1, 2], [2, 1, 3], [2, 3, 4]]
    assert (pixel[0].type, pixel[0].data.tolist()) == ("quad", [[0, 1, 3, 2]])
    grid = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 2 2 1\n"
    (tmp_path / "grid.vtk").write_text(f"{grid}POINTS 4 float\n0 0 0 1 0 0 0 1 0 1 1 0\n")
    assert read(tmp_path / "grid.vtk").surface.face_count == 1
