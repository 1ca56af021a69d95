# SPDX-License-Identifier: GPL-3.0-or-later
"""Planes that meet where the corners of their regions are.

Where planes are almost parallel, or where four meet, they have a point in common that is far from
the corner, or none. So planes give way a little. In the sense of least squares, corners x_v lie in
all of their planes n_r.x = o_r, stay near the surface w_v, and planes near those that fit their
regions, by the mean of the squared distances d over a region:

    K^2 sum_vr (n_r.x_v - o_r)^2 + S^2 sum_v |x_v - w_v|^2 + sum_r mean d_r^2

A plane is a tilt (2,) about the centroid of its region and a height there, so that the last sum is
quadratic. The first is made so by Newton's method without second derivatives.
"""

from dataclasses import replace

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import spsolve

from ..algebra import sums_by_group
from ..surface.details import unit

STAY = 0.15
"""S: corners rather go along the surface than planes leave it"""
MEET = 10.0, 30.0, 100.0, 300.0, 1000.0, 1000.0
"""K, step by step"""
_LEAST_TILT = 1e-6  # weight of a tilt of a region without extent
_FIXED = 1e6  # weight of a corner off its wall


def met(W, F, graph, regions, corners, walls):
    """Return Regions whose planes meet in corners, where they can without leaving the surface.

    Planes that face a direction exactly only move along it.

    `W`, `F`: positions (n,3) and triangles (m,3). `graph`: FaceGraph. `regions`: Regions.
    `corners`: (p,2) int, pairs of a vertex and a region that has a corner there. `walls`: as of
    `nearest_on_planes`.
    """
    vertices, v = np.unique(corners[:, 0], return_inverse=True)
    v, r = v.ravel(), corners[:, 1]
    count, k = 3 * len(vertices), len(regions.offsets)
    w = W[vertices]
    middle, axes, prior = _priors(W[F].mean(axis=1), graph.areas, regions)
    prior = sp.csr_matrix(sp.block_diag([STAY**2 * sp.identity(count), *prior]))
    for is_inside, wall in walls:
        prior += _FIXED * _held(np.flatnonzero(is_inside[vertices]), wall, count + 3 * k)
    columns = np.stack([3 * v, 3 * v + 1, 3 * v + 2] + [count + 3 * r + j for j in range(3)])
    base = np.einsum("kj,kj->k", middle, regions.normals) - regions.offsets
    x, planes = w.copy(), np.zeros((k, 3))
    for weight in MEET:
        normals = regions.normals + np.einsum("kij,ki->kj", axes, planes[:, :2])
        away = x[v] - middle[r]
        gaps = np.einsum("pj,pj->p", normals[r], away) - planes[r, 2] + base[r]
        slopes = np.einsum("pij,pj->ip", axes[r], away) * ~regions.is_faced[r]
        values = np.concatenate([normals[r].T, slopes, [-np.ones(len(r))]])
        places = np.tile(np.arange(len(r)), 6), columns.ravel()
        J = sp.csr_matrix((values.ravel(), places), (len(r), count + 3 * k))
        now = np.concatenate([(x - w).ravel(), planes.ravel()])
        A = sp.csc_matrix(weight**2 * (J.T @ J) + prior)
        change = spsolve(A, -(weight**2 * (J.T @ gaps) + prior @ now))
        along, turn = np.split(np.asarray(change), [count])
        x, planes = x + along.reshape(-1, 3), planes + turn.reshape(-1, 3)
    normals = regions.normals + np.einsum("kij,ki->kj", axes, planes[:, :2])
    size = np.linalg.norm(normals, axis=1)
    offsets = np.einsum("kj,kj->k", normals, middle) + planes[:, 2] - base
    return replace(regions, normals=normals / size[:, None], offsets=offsets / size)


def _priors(C, areas, regions):
    """Return centroids (k,3), axes (k,2,3) across the normals, and mean squared distances (k,3,3).

    The last as quadratic forms of the tilt along the axes and of the height.
    """
    region, k = regions.of_triangle, len(regions.offsets)
    share = areas / np.maximum(regions.areas, np.finfo(float).tiny)[region]
    middle = sums_by_group(share[:, None] * C, region, k)
    least = np.eye(3)[np.abs(regions.normals).argmin(axis=1)]
    across = unit(np.cross(least, regions.normals))
    axes = np.stack([across, np.cross(regions.normals, across)], axis=1)
    local = np.einsum("mij,mj->mi", axes[region], C - middle[region])
    forms = np.zeros((k, 3, 3))
    forms[:] = np.diag([_LEAST_TILT, _LEAST_TILT, 1.0])
    np.add.at(forms[:, :2, :2], region, share[:, None, None] * local[:, :, None] * local[:, None])
    return middle, axes, forms


def _held(at, wall, size):
    """Return the quadratic form of the distances of corners (h,) from a wall."""
    columns = (3 * at[:, None] + np.arange(3)).ravel()
    places = np.repeat(np.arange(len(at)), 3), columns
    S = sp.csr_matrix((np.tile(wall, len(at)), places), shape=(len(at), size))
    return S.T @ S
