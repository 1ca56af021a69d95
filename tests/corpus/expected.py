# SPDX-License-Identifier: GPL-3.0-or-later
"""What must happen with each file of the corpus when it is given to ``headless_render.py``."""

from importlib.metadata import version

DONE = {
    # name: vertices of the result, which is finite
    "moebius.obj": 24,
    "book.obj": 7,
    "two_cubes_one_vertex.obj": 15,
    "each_face_twice.obj": 8,
    "mixed_winding.obj": 8,
    "doubled_corners.obj": 8,
    "hole_by_a_bridge.obj": 8,
    "a_line.obj": 8,
    "a_point.obj": 8,
    "a_plane.obj": 8,
    "tiny.obj": 8,
    "huge.obj": 8,
    "far_away.obj": 8,
    "loose.obj": 11,
    # Blender leaves out what makes no sense, and the rest is sound:
    "index_too_large.obj": 8,
    "index_zero.obj": 8,
    "two_corners.obj": 8,
    "noise_inside.obj": 8,
    "index_too_large.ply": 8,
    "index_negative.ply": 8,
    "index_too_large_text.ply": 8,
    "two_corners.ply": 8,
    "doubled_corners.ply": 8,
    "buffer_too_short.gltf": 3,
}
REFUSED = {
    # name: words of the one line on standard error, beside the name of the file
    "bom_and_carriage_returns.obj": ["byte order mark"],
    "only_doubled_corners.obj": ["without faces"],
    "only_index_too_large.obj": ["without faces"],
    "too_huge.obj": ["finite"],
    "beyond_all_numbers.obj": ["vertex 8", "finite"],
    "words_for_numbers.obj": ["vertex 8", "finite"],
    "two_coordinates.obj": ["vertex 8", "finite"],
    "cut_vertices.ply": ["cannot be read"],
    "cut_faces.ply": ["cannot be read"],
    "row_too_short.ply": ["vertex 7", "finite"],
    "face_without_corners.ply": ["cannot be read"],
    "count_negative.ply": ["cannot be read"],
    "count_too_large.ply": ["cut off"],
    "count_no_memory.ply": ["cut off"],
    "header_only.ply": ["cannot be read"],
    "no_faces.ply": ["without faces"],
    "cut.stl": ["without faces"],
    "count_too_large.stl": ["without faces"],
    "count_too_small.stl": ["without faces"],
    "no_triangles.stl": ["without faces"],
    "without_area.stl": ["without faces"],
    "text_cut.stl": ["cannot be read"],
    "index_too_large.usda": ["refers to vertex 99", "only 8"],
    "index_negative.usda": ["refers to vertex -1", "only 8"],
    "index_too_large.gltf": ["cannot be read", "out of bounds"],
    "cut.gltf": ["cannot be read"],
}
if version("bpy") >= "5.3":  # whose importer leaves out what makes no sense, as others do
    for name in ("index_too_large.usda", "index_negative.usda"):
        del REFUSED[name]
        DONE[name] = 8
