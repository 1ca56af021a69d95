# SPDX-License-Identifier: GPL-3.0-or-later
"""How a user calls the library: `test_types.py` has it checked, nobody runs it."""

import numpy as np

import cubic_craft
from cubic_craft import (
    ProxyOptions,
    Run,
    Setup,
    Stylization,
    auto_orient,
    flatten_facets,
    rest_mesh,
    run,
    stylize,
    triangle_areas_and_normals,
)
from cubic_craft.styles import forms
from cubic_craft.styles.polytope import from_directions

V = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
F = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])

result = stylize(V, F, 0.4, pinned=[0], proxy=ProxyOptions(), keep_rotation=True, device="cpu")
print(result.energy.total, result.reason, result.rotations.shape, (result.positions - V).max())
print(stylize([[0, 0, 0]], [[0, 1, 2], [0, 1, 2, 3]], np.ones(4), form=forms.prism(5)) == result)
areas, normals = triangle_areas_and_normals(V, F)
Q = auto_orient(normals, areas, from_directions(np.eye(3)))
setup = Setup(rest_mesh(V, F), pinned=np.array([True, False, False, False]))
stylization = Stylization(setup, 0.4, Q)
print(run(stylization).converged, Run(stylization).iterations, stylization.positions.shape)
print(setup.rest.areas.sum(), setup.posed(V).pinned, cubic_craft.__version__.upper())
print(flatten_facets(V, F, np.eye(3), angle=0.3, tolerance=0.1).positions.shape)

stylize(V, F, orientaton=Q)  # wrong
stylize(V, F, device="cuda")  # wrong
stylize(V, F, keep_rotation="no")  # wrong
stylize(V, F, form="octahedron")  # wrong
Stylization(setup, 0.4, precision="f16")  # wrong
ProxyOptions(solidity="much")  # wrong
print(result.position)  # wrong
cubic_craft.stilize(V, F)  # wrong
