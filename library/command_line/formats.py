# SPDX-License-Identifier: GPL-3.0-or-later
"""The file formats, and what meshio's writers leave out of each.

Of meshio's formats, the first are the ones that are used for surfaces, consist of a single file and
are tested here.
"""

from typing import NamedTuple


class Format(NamedTuple):
    """What a format can hold."""

    name: str
    """as meshio calls it"""
    has_polygons: bool
    """or triangles only"""
    has_point_data: bool = False
    has_cell_data: bool = False
    is_float32: bool = False
    options: dict[str, bool] = {}
    """of the writer"""
    writer: str = ""
    """as meshio calls it, if not by the name"""


FORMATS = {
    ".obj": Format("obj", has_polygons=True),
    ".ply": Format("ply", has_polygons=True, has_point_data=True),
    ".stl": Format("stl", has_polygons=False, is_float32=True, options={"binary": True}),
    ".off": Format("off", has_polygons=False),
    # What meshio writes as version 5.1 has types of data that VTK does not read.
    ".vtk": Format(
        "vtk", has_polygons=True, has_point_data=True, has_cell_data=True, writer="vtk42"
    ),
    ".vtu": Format("vtu", has_polygons=True, has_point_data=True, has_cell_data=True),
    # These two meshio does not know: see `gltf_file`.
    ".glb": Format("glTF", has_polygons=False, is_float32=True),
    ".gltf": Format("glTF", has_polygons=False, is_float32=True),
}
