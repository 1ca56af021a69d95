# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of other libraries: those of trimesh and of meshio, which are known by what they have.

Neither library is imported.
"""

from collections.abc import Callable
from copy import deepcopy
from typing import Any, Concatenate, ParamSpec, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .aliases import Faces, FloatArray
from .errors import CubicCraftError
from .mesh.mesh_checks import check_mesh
from .one_call import stylize

M = TypeVar("M")
P = ParamSpec("P")

FACES = ("triangle", "quad", "polygon")
"""meshio's names of the cells of a surface"""
_NORMALS = ("nx", "ny", "nz")


def _with_arguments_of(
    function: Callable[Concatenate[ArrayLike, Faces, P], object],
) -> Callable[[Callable[..., Any]], Callable[Concatenate[M, P], M]]:
    """Tell type checkers that a function of a mesh takes what another one of V and F does."""
    return lambda decorated: decorated


@_with_arguments_of(stylize)
def stylize_mesh(mesh: M, cubeness: ArrayLike = 0.4, pinned: ArrayLike = (), **options: Any) -> M:
    """Return the cubic version of a mesh or a scene of trimesh, or of a mesh of meshio.

    Colors, UVs, materials and other data stay. Normals of points that meshio has read turn with the
    surface; trimesh computes its own anew.

    Parameters
    ----------
    mesh : trimesh.Trimesh, trimesh.Scene or meshio.Mesh
        It is not changed. Lines and points stay where they are, unless they belong to the surface.
        The meshes of a scene are solved together, where it places them.
    cubeness : float or (n,) numpy array
        As for `stylize`; the vertices of a scene are those of its nodes, in their order.
    pinned : (k,) numpy int array or (n,) numpy bool array
        As for `stylize`.
    **options
        All other arguments of `stylize`.

    Returns
    -------
    trimesh.Trimesh, trimesh.Scene or meshio.Mesh
        A new one of the same type. A mesh that a scene has in several places becomes one for each.

    Raises
    ------
    CubicCraftError
        The mesh is of another type or has no faces, or as for `stylize`.

    See Also
    --------
    stylize : For arrays; also returns the energy and whether the run has converged.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> import numpy as np
    >>> from solver import ball, stylize_mesh
    >>> V, F = ball()
    >>> mesh = SimpleNamespace(vertices=V, faces=F)  # instead of a trimesh.Trimesh
    >>> cubic = stylize_mesh(mesh, 0.6, device="numpy")
    >>> round(float(np.linalg.norm(cubic.vertices - V, axis=1).max()), 2)  # the largest movement
    0.26
    """
    given, made = _any(mesh), _any(deepcopy(mesh))
    if hasattr(mesh, "points") and hasattr(mesh, "cells"):
        return _stylized_meshio(given, made, (cubeness, pinned), options)
    if hasattr(mesh, "geometry") and hasattr(mesh, "graph"):
        return _stylized_scene(given, made, (cubeness, pinned), options)
    if not (hasattr(mesh, "vertices") and hasattr(mesh, "faces")):
        raise CubicCraftError(
            "the mesh must have vertices and faces, as those of trimesh, or points and cells, as"
            f" those of meshio, which a {type(mesh).__name__} does not; load it with one of them"
        )
    made.vertices = stylize(given.vertices, given.faces, cubeness, pinned, **options).positions
    return made


def with_turned_normals(
    point_data: dict[str, NDArray[Any]], rotations: FloatArray
) -> dict[str, NDArray[Any]]:
    """Return data of points, as meshio names it, with normals that fit the new shape."""
    turned = dict(point_data)
    if all(name in point_data for name in _NORMALS):
        columns = [point_data[name] for name in _NORMALS]
        normals = np.einsum("nij,nj->ni", rotations, np.stack(columns, axis=1))
        turned.update(
            (name, column.astype(old.dtype))
            for name, column, old in zip(_NORMALS, normals.T, columns, strict=True)
        )
    for name, data in point_data.items():
        if name.lower() in ("normal", "normals") and data.shape == (len(rotations), 3):
            turned[name] = np.einsum("nij,nj->ni", rotations, data).astype(data.dtype)
    return turned


def _any(mesh: object) -> Any:
    return mesh


def _stylized_meshio(given: Any, made: Any, style: Any, options: dict[str, Any]) -> Any:
    faces: list[NDArray[Any]] = []
    for block in given.cells:
        if block.type in FACES and len(block.data):
            faces.append(check_mesh(given.points, block.data)[1])
        elif block.dim > 1 and block.type not in FACES:
            raise CubicCraftError(
                f"the mesh has cells of the type {block.type}; give a surface of triangles, quads"
                " and polygons"
            )
    triangles = np.concatenate(faces) if faces else np.empty((0, 3), int)
    result = stylize(given.points, triangles, *style, **options)
    points = np.asarray(given.points)
    made.points = result.positions.astype(points.dtype if points.dtype.kind == "f" else float)
    made.point_data = with_turned_normals(given.point_data, result.rotations)
    return made


def _stylized_scene(given: Any, made: Any, style: Any, options: dict[str, Any]) -> Any:
    points, faces = [np.empty((0, 3))], [np.empty((0, 3), int)]
    places: list[tuple[str, str, NDArray[Any], slice]] = []
    count = 0
    for node in given.graph.nodes_geometry:
        place, name = given.graph[node]
        mesh = given.geometry[name]
        if not hasattr(mesh, "faces"):
            continue  # lines and points
        turn = np.linalg.det(place[:3, :3])
        if turn == 0.0:
            raise CubicCraftError(f"the node {node!r} has a scale of zero; apply its scale")
        points.append(mesh.vertices @ place[:3, :3].T + place[:3, 3])
        faces.append(count + (mesh.faces if turn > 0.0 else mesh.faces[:, ::-1]))
        places.append((node, name, place, slice(count, count + len(mesh.vertices))))
        count += len(mesh.vertices)
    result = stylize(np.concatenate(points), np.concatenate(faces), *style, **options)
    used: set[str] = set()
    for node, name, place, part in places:
        mesh = made.geometry[name]
        if name in used:
            mesh, name = given.geometry[name].copy(), f"{name} of {node}"
            made.geometry[name] = mesh
            made.graph.update(node, matrix=made.graph.get(node)[0], geometry=name)
        used.add(name)
        mesh.vertices = (result.positions[part] - place[:3, 3]) @ np.linalg.inv(place[:3, :3]).T
    return made
