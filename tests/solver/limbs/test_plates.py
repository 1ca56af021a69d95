# SPDX-License-Identifier: GPL-3.0-or-later
"""Plates, such as wings and fins, stay flat and as aslant as they were."""

import numpy as np
import proxy_shapes
import pytest
import shapes

from solver import ProxyOptions, rest_mesh, stylize, triangle_areas_and_normals

DEFAULTS = ProxyOptions()
STYLE = {"proxy": DEFAULTS, "keep_rotation": True, "crispness": 0.9}


def bent_sheet(degrees, length=1.0, width=1.0, count=12):
    """Return a sheet of two planes, each (length, width), which rise by so many degrees."""
    x = np.linspace(-length, length, 2 * count + 1)
    y = np.linspace(0.0, width, count + 1)
    x, y = (values.ravel() for values in np.meshgrid(x, y, indexing="ij"))
    slope = np.radians(degrees)
    V = np.stack([np.cos(slope) * x, y, np.sin(slope) * np.abs(x)], axis=1)
    i = np.arange(len(V)).reshape(2 * count + 1, count + 1)
    a, b, c, d = (z.ravel() for z in (i[:-1, :-1], i[1:, :-1], i[1:, 1:], i[:-1, 1:]))
    return V, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def solid(V, F, thickness):
    """Return a plate with such a sheet as its upper side, as thick as that along Z."""
    n = len(V)
    edges = np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])
    is_inner = (edges[:, None] == edges[None, :, ::-1]).all(axis=2).any(axis=1)
    a, b = edges[~is_inner].T
    rim = np.concatenate([np.stack([a, a + n, b], 1), np.stack([b, a + n, b + n], 1)])
    return np.vstack([V, V - [0, 0, thickness]]), np.concatenate([F, F[:, ::-1] + n, rim])


def wing(turn):
    """Return an ellipsoid of 0.8 by 0.4 by 0.06, whose rim is round."""
    V, F = proxy_shapes.uv_sphere(32, 16)
    return V / np.linalg.norm(V, axis=1).max() * [0.8, 0.4, 0.06] @ turn.T, F


def normal_and_bumps(V, F):
    """Return the mean normal of triangles that face alike, and the degrees within 90 % lie."""
    areas, normals = triangle_areas_and_normals(V, F)
    normal = areas @ normals
    normal /= np.linalg.norm(normal)
    return normal, np.degrees(np.quantile(np.arccos(np.clip(normals @ normal, -1, 1)), 0.9))


def angle(a, b):
    return np.degrees(np.arccos(np.clip(abs(a @ b), 0.0, 1.0)))


@pytest.mark.parametrize("degrees", [25.0, 40.0])
def test_both_planes_of_a_bent_plate_stay_planes(degrees):
    """The whole became an arch, and what was thinner crumpled."""
    upper, F = bent_sheet(degrees)
    V, faces = solid(upper, F, 0.06)
    U = stylize(V, faces, 0.4, **STYLE).positions
    middles = upper[F].mean(axis=1)[:, 0]
    is_inner = (np.abs(middles) > 0.1) & (np.abs(middles) < 0.6)
    for rows in (is_inner & (middles < 0.0), is_inner & (middles > 0.0)):
        before, _ = normal_and_bumps(V, F[rows])
        normal, bumps = normal_and_bumps(U, F[rows])
        assert angle(before, normal) < 3.0 and bumps < 3.0


@pytest.mark.parametrize("shape", ["closed", "open"])
def test_a_fin_stays_as_aslant_as_it_was(shape):
    fin, F = bent_sheet(0.0, 0.5, 1.2)
    fin[:, 0] *= 1.0 - 0.5 * fin[:, 1]  # no box, and
    fin[:, 2] += 0.03 * fin[:, 0] ** 2  # no planar sheet, which is not drawn to the form at all
    if shape == "closed":
        fin, F = solid(fin, F, 0.05)
    upright = fin @ shapes.rotation(x=90.0).T + [0, 0, 0.5]
    V, faces = proxy_shapes.joined(shapes.sphere(), (upright @ shapes.rotation(x=35.0).T, F))
    U = stylize(V, faces, 0.4, **STYLE).positions
    n = len(V) - len(fin)
    x, y, _ = fin[F].mean(axis=1).T
    above = F[(np.abs(x) < 0.15) & (y > 0.5) & (F < 25 * 13).all(axis=1)]
    before, _ = normal_and_bumps(V[n:], above)
    normal, bumps = normal_and_bumps(U[n:], above)
    assert angle(before, normal) < 3.0 and bumps < 3.0


def test_a_plate_whose_rim_is_round_keeps_its_direction():
    turn = shapes.rotation(x=30.0, y=-20.0)
    V, F = proxy_shapes.joined(*(wing(turn), shapes.sphere()))
    n = len(wing(turn)[0])
    U = stylize(V, F, 0.4, **STYLE).positions[:n]
    thinnest = np.linalg.eigh(np.cov(U.T))[1][:, 0]
    assert angle(thinnest, turn[:, 2]) < 4.0


HEXAGON = [(0.02, 0.0), (1.0, 0.0), (1.0, 1.2), (0.94, 1.2), (0.94, 0.06), (0.02, 0.06)]


@pytest.mark.parametrize("around", [6, 40])
def test_walls_that_close_around_something_are_none(around):
    """A hexagonal pot becomes square, and the bottom of a bowl lies as its walls do."""
    V, F = proxy_shapes.revolved(HEXAGON, around, 0.15)
    assert not rest_mesh(V @ shapes.rotation(x=20.0).T, F, DEFAULTS).limbs.shares.nnz
