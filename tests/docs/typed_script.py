# SPDX-License-Identifier: GPL-3.0-or-later
"""How a user calls the library: `test_types.py` has it checked, nobody runs it."""

import numpy as np

import cubic_craft
from cubic_craft import (
    Pose,
    ProxyOptions,
    Run,
    Setup,
    SolverOptions,
    Style,
    Stylization,
    auto_orient,
    flatten_facets,
    rest_mesh,
    run,
    stylize,
    stylize_mesh,
    triangle_areas_and_normals,
)
from cubic_craft.styles import forms
from cubic_craft.styles.polytope import from_directions

V = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
F = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])


class Mesh:
    """As of a library that has no types."""

    vertices = V
    faces = F


MESH = Mesh()
result = stylize(V, F, 0.4, pinned=[0], proxy=ProxyOptions(), keep_rotation=True, device="cpu")
print(result.energy.total, result.reason, result.rotations.shape, (result.positions - V).max())
print(stylize([[0, 0, 0]], [[0, 1, 2], [0, 1, 2, 3]], np.ones(4), form=forms.prism(5)) == result)
areas, normals = triangle_areas_and_normals(V, F)
Q = auto_orient(normals, areas, from_directions(np.eye(3)))
setup = Setup(rest_mesh(V, F), pinned=np.array([True, False, False, False]))
options = SolverOptions(device="cpu", keep_rotation=True)
half = Style(np.ones(4), Q, [forms.cube(), forms.prism(5)], form_of=[0, 0, 1, 1])
stylization = Stylization(setup, half, Pose(targets=V), options)
print(Stylization(setup, 0.4).options.precision, Stylization(setup, [0.1, 0.2, 0.3, 0.4]).rest)
print(run(stylization).converged, Run(stylization).iterations, stylization.positions.shape)
print(setup.rest.areas.sum(), setup.posed(V).pinned, cubic_craft.__version__.upper())
print(flatten_facets(V, F, np.eye(3), angle=0.3, tolerance=0.1).positions.shape)

print(stylize_mesh(MESH, 0.4, [0], keep_rotation=True, form="prism").vertices)

stylize(V, F, orientaton=Q)  # wrong
stylize_mesh(MESH, orientaton=Q)  # wrong
stylize_mesh(MESH, device="cuda")  # wrong
stylize(V, F, device="cuda")  # wrong
stylize(V, F, keep_rotation="no")  # wrong
stylize(V, F, form=8)  # wrong
SolverOptions(precision="f16")  # wrong
Stylization(setup, 0.4, Q)  # wrong
Style(0.4, form=8)  # wrong
ProxyOptions(solidity="much")  # wrong
print(result.position)  # wrong
cubic_craft.stilize(V, F)  # wrong
