# SPDX-License-Identifier: GPL-3.0-or-later
"""Read and write mesh files through meshio.

See `obj_text` and `ply_header` for what it gets wrong, and `gltf_file` for a format that it does
not know.

meshio prints its messages, and ends the process where a file cannot be read. Here they become
errors, and notes of what a format cannot hold.
"""

import contextlib
import io
import stat
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import meshio
import numpy as np

from solver.console.errors import InputError
from solver.meshes import FACES, with_turned_normals

from .formats import FORMATS, Format
from .gltf_file import GltfFile, write_surface
from .obj_text import ObjText
from .ply_header import readable_ply
from .surface import Surface

_GLTF = (".glb", ".gltf")
_LARGEST = 1e75  # the fourth power is finite


@dataclass(frozen=True)
class MeshFile:
    """A file that was read."""

    surface: Surface
    mesh: Any
    """meshio.Mesh with everything that meshio can write"""
    whole: ObjText | GltfFile | None
    """the file itself, of a format of which all is kept"""


def read(path: Path) -> MeshFile:
    """Read a file with a surface.

    Raises InputError: it is missing or cannot be read, or is no surface.
    """
    try:
        if not stat.S_ISREG(path.stat().st_mode) and not path.is_dir():
            raise InputError(f"{path}: is a device or a pipe; give a file")
        if not path.stat().st_size:
            raise InputError(f"{path}: the file is empty; export it again")
        if path.suffix.lower() == ".obj":
            obj = ObjText(path)
            _check_size(path, obj.points)
            blocks = [(_cell_type(block), block.astype(np.int32)) for block in obj.faces]
            return MeshFile(Surface(obj.points, obj.faces), meshio.Mesh(obj.points, blocks), obj)
        if path.suffix.lower() in _GLTF:
            return _read_gltf(path)
    except FileNotFoundError:
        raise InputError(f"{path}: there is no such file; check the path") from None
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}); check the path") from None
    mesh = _read_with_meshio(path)
    faces = [block.data for block in mesh.cells if block.type in FACES]
    _check_kind(path, mesh)
    points = np.array(mesh.points, dtype=np.float64)
    _check_size(path, points)
    for block in faces:
        if block.shape[1] < 3:
            message = f"a face has {block.shape[1]} corners; is the file cut off?"
            raise InputError(f"{path}: {message} Export it again")
        if block.min(initial=0) < 0 or block.max(initial=0) >= len(points):
            message = f"a face refers to a vertex that is not among the {len(points)}"
            raise InputError(f"{path}: {message}; export it again")
    return MeshFile(Surface(points, faces), mesh, None)


def write(file: MeshFile, path: Path, positions: np.ndarray, rotations: np.ndarray) -> list[str]:
    """Write the file with other positions, and return notes of what the format cannot hold.

    `path`: its suffix is the format. `positions`: (n,3). `rotations`: (n,3,3), what normals in the
    file are rotated by. Raises InputError: the format cannot hold the mesh; OSError: the disk is
    full, or something else is wrong with it.
    """
    suffix = path.suffix.lower()
    if isinstance(file.whole, ObjText) and suffix == ".obj":
        file.whole.write(path, positions)
        return []
    if isinstance(file.whole, GltfFile) and suffix in _GLTF:
        _check_float32(positions)
        file.whole.write(path, positions, rotations)
        return []
    kind = FORMATS[suffix]
    notes: list[str] = []
    mesh = _fitting(file, kind, positions, rotations, notes)
    if suffix in _GLTF:
        write_surface(path, mesh.points, file.surface.triangles)
        return notes
    with _quiet() as said:
        try:
            meshio.write(path, mesh, file_format=kind.writer or kind.name, **kind.options)
        except OSError:
            raise
        except (Exception, SystemExit) as error:
            reason = _one_line(error, said)
            raise InputError(
                f"cannot be written as {path.suffix} ({reason}); choose another format"
            ) from error
    return notes


def _read_gltf(path: Path) -> MeshFile:
    try:
        file = GltfFile(path)
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    _check_size(path, file.points)
    mesh = meshio.Mesh(file.points.astype(np.float32), [("triangle", file.triangles)])
    return MeshFile(Surface(file.points, [file.triangles]), mesh, file)


def _read_with_meshio(path: Path) -> Any:
    kind = FORMATS[path.suffix.lower()]
    with _quiet() as said:
        try:
            if kind.name == "ply":
                return meshio.read(io.BytesIO(readable_ply(path.read_bytes())), "ply")
            return meshio.read(path, kind.name)
        except InputError as error:
            raise InputError(f"{path}: {error}") from None
        except (Exception, SystemExit) as error:  # its readers raise anything
            reason = _one_line(error, said)
            message = f"{path}: cannot be read as {path.suffix.lower()} ({reason})"
            raise InputError(f"{message}; export it again, or in another format") from error


def _check_kind(path: Path, mesh: Any) -> None:
    """Refuse what is no surface in space."""
    if not len(mesh.points):
        raise InputError(f"{path}: has no vertices; is the file cut off? Export it again")
    if mesh.points.ndim != 2 or mesh.points.shape[1] != 3:
        raise InputError(f"{path}: its points are not in space; export it with three coordinates")
    for block in mesh.cells:
        if block.dim == 3 or (block.dim == 2 and block.type not in FACES):
            raise InputError(
                f"{path}: has cells of the type {block.type}; give a surface of triangles, quads "
                "and polygons"
            )


def _check_size(path: Path, points: np.ndarray) -> None:
    """Refuse finite positions (n,3) whose areas and volumes are not."""
    sizes = np.abs(points).max(axis=1, initial=0.0)
    (found,) = np.nonzero((sizes > _LARGEST) & np.isfinite(sizes))
    if len(found):
        reason = f"vertex {found[0] + 1} has a coordinate of {sizes[found[0]]:.3g}"
        raise InputError(f"{path}: {reason}, which is too large; repair the file, or scale it down")


def _check_float32(positions: np.ndarray) -> None:
    with np.errstate(over="ignore"):
        is_held = np.isfinite(positions.astype(np.float32)).all()
    if not is_held:
        raise InputError("its coordinates are too large for this format; choose .obj or .vtu")


def _fitting(
    file: MeshFile, kind: Format, positions: np.ndarray, rotations: np.ndarray, notes: list[str]
) -> Any:
    """Return the mesh with its new positions as far as a format can hold it."""
    mesh, surface = file.mesh, file.surface
    dtype = np.float32 if kind.is_float32 or mesh.points.dtype.itemsize == 4 else np.float64
    if dtype is np.float32:
        _check_float32(positions)
    cells = [(block.type, _native(block.data)) for block in mesh.cells]
    cell_data = {name: [_native(x) for x in data] for name, data in mesh.cell_data.items()}
    point_data = {name: _native(data) for name, data in mesh.point_data.items()}
    cell_data.pop("facet_normals", None)  # of .stl files, which the writer computes anew
    if not kind.has_polygons:
        if len(surface.triangles) != surface.face_count:
            notes.append(f"{surface.face_count} faces become {len(surface.triangles)} triangles")
        elif any(block.dim < 2 for block in mesh.cells):
            notes.append("lines and single points are left out")
        cells, cell_data = [("triangle", surface.triangles.astype(np.int32))], {}
    if not kind.has_cell_data and cell_data:
        notes.append(f"left out of the cells: {', '.join(cell_data)}")
        cell_data = {}
    point_data = with_turned_normals(point_data, rotations)
    lost = [x for x, data in point_data.items() if not kind.has_point_data or _too_wide(data, kind)]
    if lost:
        notes.append(f"left out of the points: {', '.join(lost)}")
        point_data = {name: data for name, data in point_data.items() if name not in lost}
    return meshio.Mesh(
        positions.astype(dtype),
        cells,
        point_data,
        cell_data,
        field_data=mesh.field_data if kind.has_cell_data else None,
    )


def _too_wide(data: np.ndarray, kind: Format) -> bool:
    return kind.name == "ply" and data.ndim > 1


def _native(data: np.ndarray) -> np.ndarray:
    """Return an array in the byte order of the machine, which not all writers convert to."""
    data = np.asarray(data)
    if data.dtype.kind == "i" and data.dtype.itemsize == 8 and abs(data).max(initial=0) < 2**31:
        return data.astype(np.int32)  # which .ply needs
    return data.astype(data.dtype.newbyteorder("="))


def _cell_type(block: np.ndarray) -> str:
    return {3: "triangle", 4: "quad"}.get(block.shape[1], "polygon")


@contextlib.contextmanager
def _quiet() -> Iterator[io.StringIO]:
    """Collect what meshio prints."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        yield said


def _one_line(error: BaseException, said: io.StringIO) -> str:
    """Return the reason of an error; where it has none, what was printed."""
    texts = ["" if isinstance(error, SystemExit) else str(error), said.getvalue()]
    lines = [line.strip() for text in texts for line in text.splitlines() if line.strip()]
    return lines[0] if lines else type(error).__name__
