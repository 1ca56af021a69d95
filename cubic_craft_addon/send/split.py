# SPDX-License-Identifier: GPL-3.0-or-later
"""More triangles where shape keys move a low-poly mesh, which is flat where a face smiles."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import bmesh
import bpy
import numpy as np
from mathutils.bvhtree import BVHTree

from ...solver.mesh.rest_measures import areas_and_normals
from .. import mesh_bridge

_EXACT = 0.001
"""of the largest extent: so much a place may move otherwise than the same of the old surface"""
_WORST = 0.5
"""of the largest error: triangles with less wait"""
_ROUNDS = 30
_ENDS = np.array([[0, 1], [1, 2], [2, 0]])


@dataclass(frozen=True)
class OldSurface:
    """What a low-poly mesh stands for."""

    positions: np.ndarray
    """(n,3)"""
    triangles: np.ndarray
    """(m,3)"""
    offsets: Mapping[str, np.ndarray]
    """(n,3) of the vertices, by the names of the shape keys"""


def split_for_keys(mesh: bpy.types.Mesh, surface: OldSurface, most: int) -> int:
    """Split triangles that shape keys move otherwise than the surface that they stand for.

    The longest edges of the worst ones are cut in halves, round by round. The shape stays.

    `mesh`: of triangles. `most`: of the triangles that are added. Returns their number.
    """
    exact = _EXACT * float(np.ptp(surface.positions, axis=0).max())
    is_moved = np.zeros(len(surface.positions), bool)
    for moved in surface.offsets.values():
        is_moved |= np.linalg.norm(moved, axis=1) > exact
    rows, before = np.flatnonzero(is_moved), len(mesh.polygons)
    for _ in range(_ROUNDS):
        left = before + most - len(mesh.polygons)
        if left < 2 or not len(rows):
            break
        errors = _errors(mesh, surface, rows)
        least = max(exact, _WORST * errors.max())
        worst = np.argsort(-errors, kind="stable")[: np.count_nonzero(errors > least)]
        if not len(worst):
            break
        V, F = mesh_bridge.read_position(mesh), mesh_bridge.corner_vertices(mesh).reshape(-1, 3)
        ends = F[worst][:, _ENDS]
        lengths = np.linalg.norm(V[ends[:, :, 0]] - V[ends[:, :, 1]], axis=2)
        longest = ends[np.arange(len(worst)), lengths.argmax(axis=1)]
        edges = dict.fromkeys(map(tuple, np.sort(longest, axis=1).tolist()))
        _split(mesh, list(edges)[: left // 2])
    return len(mesh.polygons) - before


def _errors(mesh: bpy.types.Mesh, surface: OldSurface, rows: np.ndarray) -> np.ndarray:
    """Return how far (m,) triangles of a mesh at most are from where old vertices (k,) go."""
    positions, triangles = surface.positions, surface.triangles
    corners, shares = mesh_bridge.places_on(mesh, positions, triangles)
    V, F = mesh_bridge.read_position(mesh), mesh_bridge.corner_vertices(mesh).reshape(-1, 3)
    tree = BVHTree.FromPolygons(V.tolist(), F.tolist())
    near = [tree.find_nearest(point) for point in positions[rows].tolist()]
    at = np.array([number for _, _, number, _ in near])
    of = mesh_bridge.shares_of(np.array([place for place, *_ in near]), V[F[at]])
    own, old = areas_and_normals(V, F)[1], areas_and_normals(positions, triangles)[1]
    is_alike = np.einsum("kcj,kj->kc", own[F[at]], old[rows]).mean(axis=1) > 0.0
    found = np.zeros(len(F))
    for moved in surface.offsets.values():
        low = np.einsum("nk,nkj->nj", shares, moved[corners])
        gaps = np.einsum("kc,kcj->kj", of, low[F[at]]) - moved[rows]
        np.maximum.at(found, at, np.linalg.norm(gaps, axis=1) * is_alike)
    return found


def _split(mesh: bpy.types.Mesh, edges: Iterable[tuple[int, int]]) -> None:
    """Cut edges between triangles, pairs of vertices, in halves, and the triangles with them."""
    edited = bmesh.new()
    try:
        edited.from_mesh(mesh)
        edited.verts.ensure_lookup_table()
        found = [edited.edges.get([edited.verts[v] for v in pair]) for pair in edges]
        for edge in found:
            assert edge is not None
            middle = bmesh.utils.edge_split(edge, edge.verts[0], 0.5)[1]
            for face in list(middle.link_faces):
                near = {other for e in middle.link_edges for other in e.verts}
                far = next(vertex for vertex in face.verts if vertex not in near)
                bmesh.utils.face_split(face, middle, far)
        edited.to_mesh(mesh)
    finally:
        edited.free()
    mesh.update()
