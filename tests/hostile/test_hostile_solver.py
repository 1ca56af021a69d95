# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever the mesh: a finite result that keeps what was promised."""

from dataclasses import replace

import numpy as np
from budget import examples
from hostile_runs import NOTHING, ROUNDING, cases, check_result, prepared, run
from hypothesis import event, given

from solver import SolverOptions, Style, Stylization


@examples(40)
@given(case=cases())
def test_a_result_keeps_what_was_promised(case):
    mesh, options, device = case
    V, F = mesh.V.copy(), mesh.triangles
    setup = prepared(mesh, options)
    result, _ = run(setup, options, device)
    event(f"{device}: {result.reason}")
    check_result(mesh, options, result)
    _, (energies,) = run(setup, options, device, keep_apart=False)
    assert mesh.V.tobytes() == V.tobytes()
    assert mesh.triangles.tobytes() == F.tobytes()
    assert energies[-1] <= energies[0] * (1 + ROUNDING) + NOTHING
    if options.targets is None:
        assert energies[-1] <= energy_at_rest(setup, options) * (1 + ROUNDING) + NOTHING
    used = np.flatnonzero(~mesh.loose)  # the same numbers, with and without loose vertices
    mesh, options = without_loose(mesh, options)
    again, _ = run(prepared(mesh, options), options, device)
    assert again.positions.tobytes() == result.positions[used].tobytes()
    assert again.rotations.tobytes() == result.rotations[used].tobytes()


def without_loose(mesh, options):
    """Return the mesh without its loose vertices, and the Options of the others."""
    used = np.flatnonzero(~mesh.loose)
    number = np.full(len(mesh.V), -1)
    number[used] = np.arange(len(used))
    faces = [tuple(number[list(face)].tolist()) for face in mesh.faces]
    kept = replace(
        options,
        cubeness=options.cubeness[used] if np.ndim(options.cubeness) else options.cubeness,
        pinned=np.setdiff1d(number[options.pinned], -1),
        targets=None if options.targets is None else options.targets[used],
    )
    return replace(mesh, V=mesh.V[used], faces=faces, edges=[]), kept


def energy_at_rest(setup, options):
    """Return the energy of the undeformed mesh with all rotations the identity."""
    rest = setup.rest
    state = Stylization(
        setup,
        Style(options.cubeness, options.orientation),
        options=SolverOptions(device="numpy", keep_rotation=options.keep_rotation),
    )
    style = state._style
    cube_normals = np.einsum(
        "nij,nj->ni", np.broadcast_to(style.Q, (len(rest.V), 3, 3)), style.normals
    )
    return (style.lam * rest.areas * np.abs(cube_normals).sum(axis=1)).sum()
