# SPDX-License-Identifier: GPL-3.0-or-later
"""Prepare a mesh: all that is computed once, regardless of cubeness, orientation and pins."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ..aliases import Faces
from ..errors import CubicCraftError
from ..inputs import instance, whole_numbers
from ..mesh.edges import Triangles
from ..mesh.mesh_checks import check_mesh, faces_of_triangles
from ..mesh.rest_measures import areas_and_normals, cotangents
from ..mesh.spokes_and_rims import spokes_and_rims
from ..mesh.topology import topology
from ..proxy import Links, ProxyOptions, no_links, surface_of
from ..proxy.cavities import links_outside
from ..proxy.creases import cubic_shares, smoothness
from ..proxy.flat_sides import stiffness
from ..proxy.neighbors import neighbor_links
from ..proxy.sheets import planar_sheets
from ..proxy.thickness import outward_sign, thickness_links
from .memory import check_memory
from .rest import LIGHT, RestMesh


def rest_mesh(
    V: ArrayLike, F: Faces, proxy: ProxyOptions | None = None, faces: ArrayLike | None = None
) -> RestMesh:
    """Build the RestMesh of a mesh.

    Parameters
    ----------
    V : (N,3) numpy array
        Rest positions, in any unit.
    F : (m,3) numpy int array, or faces with more corners
        Triangles. Polygons (m,s), or rows of any length, are split into triangles.
    proxy : ProxyOptions, optional
        How to prepare the surface; by default as in the extension. With `PAPER`, nothing is done.
    faces : (m,) numpy int array, optional
        The face that each triangle is a piece of: *Crispness* gives it one side, so that it is not
        folded. By default, the polygons of F.

    Returns
    -------
    RestMesh

    Raises
    ------
    CubicCraftError
        The mesh is invalid, or needs more memory than is free.

    Notes
    -----
    The weights are the cotangents of Pinkall and Polthier, "Computing Discrete Minimal Surfaces and
    Their Conjugates", Experimental Mathematics 2(1), 1993.

    Examples
    --------
    A coarse ball is solved on a finer copy, or as it is, as in the paper:

    >>> import numpy as np
    >>> from solver import PAPER, ball, rest_mesh
    >>> V, F = ball()
    >>> len(rest_mesh(V, F).V) > 4000, len(rest_mesh(V, F, PAPER).V)
    (True, 700)
    """
    polygons = F
    input_positions, F = check_mesh(V, polygons)
    proxy = ProxyOptions() if proxy is None else instance(proxy, "proxy", ProxyOptions)
    given = F.copy()  # it may be the caller's
    check_memory(len(input_positions), len(F))
    if faces is None:
        faces = faces_of_triangles(polygons)
    else:
        faces = whole_numbers(faces, "faces")
        if faces.shape != (len(F),):
            raise CubicCraftError(f"faces must have the shape ({len(F)},), not {faces.shape}")
    surface = surface_of(input_positions, F, proxy, faces)
    V, F = surface.V, surface.F
    triangles = Triangles(V, F)
    measures = triangles.areas, triangles.normals
    areas, normals = areas_and_normals(V, F, measures)
    C = cotangents(V, F)
    parts = topology(F, len(V))
    with ThreadPoolExecutor(1) as beside:  # most of the search lets other threads compute
        to_neighbors, search = no_links(), None
        if proxy.needs_thickness:
            search = beside.submit(links_within, triangles, normals, areas, parts.part)
        if proxy.together:
            to_neighbors = neighbor_links(V, F, normals, areas, parts.part, parts.component_count)
        smooth, shares = np.ones(len(V)), np.ones(len(V))
        is_flat = np.zeros(len(V), dtype=bool)
        if proxy.refine:
            smooth = smoothness(F, C, measures, len(V))
            shares = cubic_shares(triangles, smooth, areas)
            factors = stiffness(triangles, parts.part)
            is_flat[F[factors < 1.0]] = True
            is_sheet = planar_sheets(V, F, parts.part)[parts.part]
            factors = np.where(is_sheet[F[:, 0]], LIGHT * factors, factors)
            ends = is_sheet[to_neighbors.vertices] & (to_neighbors.coefficients != 0.0)
            to_neighbors = to_neighbors.weighted(np.where(ends.any(axis=1), LIGHT, 1.0))
            C = C * factors[:, None]
        skin = spokes_and_rims(V, F, C, triangles.edges)
        to_other_side, across_cavities, across_gaps = search.result() if search else [None] * 3
    linked = parts.linked(to_neighbors.pairs())
    walls = to_other_side, across_cavities, across_gaps
    rest = RestMesh(
        *(input_positions, surface.input_map, surface.box, V, linked, areas, normals),
        *(is_flat, smooth, shares, to_neighbors, *walls, proxy, C, skin, skin),
        triangles=given,
        unrefined=surface.unrefined,
        pieces=surface.pieces,
        faces=surface.faces,
        given_faces=faces,
    )
    return replace(rest, matrices=skin.with_links(V, rest.links))


def links_within(triangles, normals, areas, part) -> tuple[Links, Links, Links]:
    """Return the Links to the other side of parts, across their cavities, and across gaps."""
    surface = normals, areas, part, outward_sign(triangles, part)[part]
    return thickness_links(triangles.V, *surface), *links_outside(triangles, *surface)
