# SPDX-License-Identifier: GPL-3.0-or-later
"""Write the broken files of the corpus, always the same bits: ``python make_corpus.py [FOLDER]``.

What must happen with each of them stands in ``expected.py``.
"""

import json
import struct
import sys
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).resolve().parent / "files"
CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
TRIANGLES = [t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))]


def obj(V, faces, extra=""):
    """Return an .obj file."""
    lines = ["v " + " ".join(f"{x:.9g}" for x in v) for v in np.asarray(V, float)]
    lines += ["f " + " ".join(str(i + 1) for i in face) for face in faces]
    return ("\n".join(lines) + "\n" + extra).encode()


def ply(V, faces, vertex_count=None, face_count=None, index_type="int"):
    """Return a binary .ply file whose header may lie."""
    header = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(V) if vertex_count is None else vertex_count}\n"
        "property float x\nproperty float y\nproperty float z\n"
        f"element face {len(faces) if face_count is None else face_count}\n"
        f"property list uchar {index_type} vertex_indices\nend_header\n"
    )
    body = np.asarray(V, "<f4").tobytes()
    body += b"".join(struct.pack(f"<B{len(f)}i", len(f), *f) for f in faces)
    return header.encode() + body


def ply_text(V, faces):
    """Return a text .ply file; rows may be of any length."""
    rows = [" ".join(map(str, row)) for row in V] + [
        " ".join(map(str, (len(face), *face))) for face in faces
    ]
    header = ply(V, faces).split(b"end_header")[0].replace(b"binary_little_endian", b"ascii")
    return header + b"end_header\n" + "\n".join(rows).encode() + b"\n"


def stl(V, faces, count=None):
    """Return a binary .stl file whose header may lie."""
    corners = np.asarray(V, "<f4")[np.array(faces)]
    rows = [struct.pack("<3f", 0, 0, 0) + c.tobytes() + b"\0\0" for c in corners]
    return bytes(80) + struct.pack("<I", len(faces) if count is None else count) + b"".join(rows)


def usda(V, counts, indices):
    """Return a text USD file."""
    points = ", ".join(str(tuple(v)) for v in np.asarray(V, float).tolist())
    return (
        '#usda 1.0\ndef Mesh "broken"\n{\n'
        f"    int[] faceVertexCounts = {list(counts)}\n"
        f"    int[] faceVertexIndices = {list(indices)}\n"
        f"    point3f[] points = [{points}]\n}}\n"
    ).encode()


def gltf(index, length=36):
    """Return a .gltf file of one triangle, with that largest index and buffer length."""
    import base64

    data = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4").tobytes()
    data += np.array([0, 1, index], "<u4").tobytes()
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    tree = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "scene": 0,
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"uri": uri, "byteLength": 48}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": length},
            {"buffer": 0, "byteOffset": 36, "byteLength": 12},
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5125, "count": 3, "type": "SCALAR"},
        ],
    }
    return json.dumps(tree, indent=1).encode()


def _moebius():
    t = np.linspace(0, 2 * np.pi, 12, endpoint=False)
    V = [
        (
            (1 + s * np.cos(a / 2)) * np.cos(a),
            (1 + s * np.cos(a / 2)) * np.sin(a),
            s * np.sin(a / 2),
        )
        for a in t
        for s in (-0.3, 0.3)
    ]
    faces = [(2 * c, 2 * c + 2, 2 * c + 3, 2 * c + 1) for c in range(11)]
    return np.array(V), [*faces, (22, 1, 0, 23)]


def corpus():
    """Return the content of each file by its name."""
    whole_ply, whole_stl = ply(CUBE, QUADS), stl(CUBE, TRIANGLES)
    page = np.array([[0, 0, 0], [0, 0, 1], [1, 0, 0], [1, 0, 1], [0, 1, 0], [-1, 0, 1], [0, -1, 1]])
    holed = [(0, 0), (3, 0), (3, 3), (0, 3), (1, 1), (1, 2), (2, 2), (2, 1)]
    huge = b"ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
    huge += (
        b"property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    )
    return {
        "moebius.obj": obj(*_moebius()),
        "book.obj": obj(page, [(0, 1, 3, 2), (0, 1, 4), (0, 1, 5), (0, 1, 6)]),
        "two_cubes_one_vertex.obj": obj(
            np.concatenate([CUBE, CUBE[1:] * -1]),
            QUADS + [tuple(i + 7 if i else 0 for i in q) for q in QUADS],
        ),
        "each_face_twice.obj": obj(CUBE, QUADS + [q[::-1] for q in QUADS]),
        "mixed_winding.obj": obj(CUBE, [q[::-1] if n % 2 else q for n, q in enumerate(QUADS)]),
        "doubled_corners.obj": obj(CUBE, [*QUADS, (0, 0, 1), (2, 2, 2), (0, 1, 0, 1)]),
        "only_doubled_corners.obj": obj(CUBE, [(0, 0, 1), (2, 2, 2)]),
        "hole_by_a_bridge.obj": obj([(*p, 0) for p in holed], [(0, 1, 2, 3, 0, 4, 5, 6, 7, 4)]),
        "a_line.obj": obj(CUBE * [1, 0, 0], QUADS),
        "a_point.obj": obj(CUBE * 0 + 7, QUADS),
        "a_plane.obj": obj(CUBE * [1, 1, 0], QUADS),
        "tiny.obj": obj(CUBE * 1e-30, QUADS),
        "huge.obj": obj(CUBE * 1e30, QUADS),
        "too_huge.obj": obj(CUBE * 1e39, QUADS),
        "beyond_all_numbers.obj": obj(CUBE, QUADS).replace(b"v 1 1 1", b"v 1 1 1e400"),
        "far_away.obj": obj(CUBE + 1e6, QUADS),
        "loose.obj": obj(np.concatenate([CUBE, CUBE[:3] + 5]), QUADS, "l 9 10\n"),
        "index_too_large.obj": obj(CUBE, [*QUADS, (0, 1, 98)]),
        "only_index_too_large.obj": obj(CUBE, [(0, 1, 98)]),
        "index_zero.obj": obj(CUBE, [*QUADS, (0, 1, -1)]),
        "two_corners.obj": obj(CUBE, [*QUADS, (0, 1)]),
        "words_for_numbers.obj": obj(CUBE, QUADS).replace(b"v 1 1 1", b"v one 1 1"),
        "two_coordinates.obj": obj(CUBE, QUADS).replace(b"v 1 1 1", b"v 1 1"),
        "noise_inside.obj": obj(CUBE, QUADS, "").replace(b"f 1", b"\0\xff\xfe\x80 f 1", 1),
        "bom_and_carriage_returns.obj": b"\xef\xbb\xbf" + obj(CUBE, QUADS).replace(b"\n", b"\r\n"),
        "cut_vertices.ply": whole_ply[: whole_ply.index(b"end_header") + 40],
        "cut_faces.ply": whole_ply[:-20],
        "index_too_large.ply": ply(CUBE, [*QUADS[:5], (0, 1, 99)]),
        "index_negative.ply": ply(CUBE, [*QUADS[:5], (0, 1, -2)]),
        "index_too_large_text.ply": ply_text(CUBE, [*QUADS[:5], (0, 1, 99)]),
        "row_too_short.ply": ply_text(CUBE, QUADS).replace(b"1.0 1.0 1.0\n", b"1.0 1.0\n"),
        "face_without_corners.ply": ply(CUBE, [*QUADS, ()]),
        "two_corners.ply": ply(CUBE, [*QUADS, (0, 1)]),
        "doubled_corners.ply": ply(CUBE, [*QUADS, (0, 0, 1), (2, 2, 2)]),
        "count_negative.ply": ply(CUBE, QUADS, vertex_count=-8),
        "count_too_large.ply": ply(CUBE, QUADS, vertex_count=4_000),
        "count_no_memory.ply": huge + b"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        "header_only.ply": whole_ply[: whole_ply.index(b"element face")],
        "no_faces.ply": ply(CUBE, []),
        "cut.stl": whole_stl[:-30],
        "count_too_large.stl": stl(CUBE, TRIANGLES, 4_000_000_000),
        "count_too_small.stl": stl(CUBE, TRIANGLES, 3),
        "no_triangles.stl": stl(CUBE, TRIANGLES, 0)[:84],
        "without_area.stl": stl(CUBE * [1, 0, 0], TRIANGLES),
        "text_cut.stl": b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0",
        "index_too_large.usda": usda(
            CUBE, [4] * 6, [i for q in QUADS[:5] for i in q] + [0, 1, 99, 2]
        ),
        "index_negative.usda": usda(
            CUBE, [4] * 6, [i for q in QUADS[:5] for i in q] + [0, 1, -1, 2]
        ),
        "index_too_large.gltf": gltf(99),
        "buffer_too_short.gltf": gltf(2, 4000),
        "cut.gltf": gltf(2)[:200],
    }


def main(folder):
    """Write all files into the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in corpus().items():
        (folder / name).write_bytes(content)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER)
