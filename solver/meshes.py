# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes and scenes of trimesh, which are known by what they have; it is not imported."""

from collections.abc import Callable
from copy import deepcopy
from typing import Any, Concatenate, NamedTuple, ParamSpec, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .aliases import Faces, FloatArray
from .errors import CubicCraftError
from .one_call import stylize

M = TypeVar("M")
P = ParamSpec("P")


class Part(NamedTuple):
    """A node of a scene that shows a mesh."""

    node: str
    name: str
    """of the mesh"""
    place: NDArray[Any]
    """matrix (4,4)"""
    rows: slice
    """of its vertices among those of all"""


def _with_arguments_of(
    function: Callable[Concatenate[ArrayLike, Faces, P], object],
) -> Callable[[Callable[..., Any]], Callable[Concatenate[M, P], M]]:
    return lambda decorated: decorated


@_with_arguments_of(stylize)
def stylize_mesh(mesh: M, cubeness: ArrayLike = 0.4, pinned: ArrayLike = (), **options: Any) -> M:
    """Return the cubic version of a mesh or a scene of trimesh.

    Colors, UVs, materials and other data stay; trimesh computes its normals anew.

    Parameters
    ----------
    mesh : trimesh.Trimesh or trimesh.Scene
        It is not changed. Lines and points stay where they are, unless they belong to the surface.
        The meshes of a scene are solved together, where it places them.
    cubeness : float or (n,) numpy array
        As for `stylize`; the vertices of a scene are those of its nodes, in their order.
    pinned, **options
        As for `stylize`.

    Returns
    -------
    trimesh.Trimesh or trimesh.Scene
        A new one of the same type. A mesh that a scene has in several places becomes one for each.

    Raises
    ------
    CubicCraftError
        The mesh is of another type or has no faces, or as for `stylize`.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> import numpy as np
    >>> from solver import ball, stylize_mesh
    >>> V, F = ball()
    >>> mesh = SimpleNamespace(vertices=V, faces=F)  # instead of a trimesh.Trimesh
    >>> cubic = stylize_mesh(mesh, 0.6, device="numpy")
    >>> round(float(np.linalg.norm(cubic.vertices - V, axis=1).max()), 2)  # the largest movement
    0.29
    """
    given: Any = mesh
    if hasattr(mesh, "geometry") and hasattr(mesh, "graph"):
        points, faces, parts = placed_surface(given)
        result = stylize(points, faces, cubeness, pinned, **options)
        return with_positions(given, parts, result.positions)
    if not (hasattr(mesh, "vertices") and hasattr(mesh, "faces")):
        raise CubicCraftError(
            "the mesh must have vertices and faces, as those of trimesh, which a"
            f" {type(mesh).__name__} does not; load it with trimesh"
        )
    made: Any = deepcopy(mesh)
    made.vertices = stylize(given.vertices, given.faces, cubeness, pinned, **options).positions
    return made


def placed_surface(scene: Any) -> tuple[FloatArray, NDArray[Any], list[Part]]:
    """Return the meshes of a scene as one, where its nodes place them.

    Returns positions (n,3), triangles (m,3), and the parts that they are made of.

    Raises CubicCraftError: a node has no extent.
    """
    points, faces = [np.empty((0, 3))], [np.empty((0, 3), int)]
    parts, count = [], 0
    for node in scene.graph.nodes_geometry:
        place, name = scene.graph[node]
        mesh = scene.geometry[name]
        if not hasattr(mesh, "faces"):
            continue  # lines and points
        turn = np.linalg.det(place[:3, :3])
        if turn == 0.0:
            raise CubicCraftError(f"the node {node!r} has a scale of zero; apply its scale")
        points.append(mesh.vertices @ place[:3, :3].T + place[:3, 3])
        faces.append(count + (mesh.faces if turn > 0.0 else mesh.faces[:, ::-1]))
        parts.append(Part(node, name, place, slice(count, count + len(mesh.vertices))))
        count += len(mesh.vertices)
    return np.concatenate(points), np.concatenate(faces), parts


def with_positions(scene: Any, parts: list[Part], positions: FloatArray) -> Any:
    """Return a scene whose parts have other positions (n,3).

    A mesh that it has in several places becomes one for each.
    """
    made: Any = deepcopy(scene)
    used: set[str] = set()
    for node, name, place, rows in parts:
        mesh = made.geometry[name]
        if name in used:
            mesh, name = scene.geometry[name].copy(), f"{name} of {node}"
            made.geometry[name] = mesh
            parent = made.graph.transforms.parents[node]
            matrix = made.graph.get(node, parent)[0]
            made.graph.update(node, parent, matrix=matrix, geometry=name)
        used.add(name)
        mesh.vertices = (positions[rows] - place[:3, 3]) @ np.linalg.inv(place[:3, :3]).T
    return made
