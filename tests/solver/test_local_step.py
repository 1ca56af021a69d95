# SPDX-License-Identifier: GPL-3.0-or-later
"""The local step: its energy by definition, its optimality, and the backends against each other."""

import numpy as np
import pytest
import shapes
from devices import by_device
from engine_marks import needs_engine
from plain_energy import plain_energy

from solver import PAPER, Setup, SolverOptions, Style, Stylization, rest_mesh
from solver.backends import local_step_class
from solver.styles.admm import AdmmOptions

Q = shapes.rotation(25, -10, 40)


def deformed(V):
    return V + 0.08 * np.sin(4 * V[:, [1, 2, 0]] + 1.0)


def local_step(rest, cubeness, device, **options):
    lam = np.full(len(rest.V), cubeness)
    return local_step_class(device)(rest, lam, Q[None], AdmmOptions(**options))


def test_energy_matches_its_definition(device):
    rest = rest_mesh(*shapes.skewed_blob(), proxy=PAPER)
    step = local_step(rest, 0.3, device)
    U = deformed(rest.V)
    arap, cubic = (float(part.sum()) for part in step.update(U))
    expected = plain_energy(rest.V, rest.F, U, step.R, 0.3, Q)
    np.testing.assert_allclose((arap, cubic), expected, rtol=by_device(device, 1e-10, 1e-5))


@pytest.mark.parametrize("name", shapes.ALL)
def test_rotations_are_rotations(name, device):
    rest = rest_mesh(*shapes.ALL[name](), proxy=PAPER)
    step = local_step(rest, 0.5, device)
    for U in (rest.V, deformed(rest.V), rest.V * [1, 1, -1], 0 * rest.V, rest.V * [1, 0, 0]):
        step.update(U)  # mirrored, collapsed to a point, flattened to a line
        tolerance = by_device(device, 1e-12, 1e-6)
        product = step.R @ step.R.swapaxes(1, 2)
        np.testing.assert_allclose(product, np.tile(np.eye(3), (len(rest.V), 1, 1)), atol=tolerance)
        np.testing.assert_allclose(np.linalg.det(step.R), 1.0, atol=tolerance)


@needs_engine
@pytest.mark.parametrize("name", ["blob", "skewed_blob", "sheet", "two_blobs"])
@pytest.mark.parametrize(("precision", "tolerance"), [("f64", 1e-8), ("f32", 1e-4)])
def test_taichi_agrees_with_numpy_after_five_iterations(name, precision, tolerance):
    V, F = shapes.ALL[name]()
    results = []
    # In 32 bit the tolerances cannot be smaller, and the comparison must not be one of tolerances.
    admm = AdmmOptions() if precision == "f64" else AdmmOptions(absolute=1e-5, relative=1e-3)
    for device, kind in (("numpy", None), ("cpu", precision)):
        run = Stylization(
            Setup(rest_mesh(V, F, PAPER)),
            Style(0.4, Q),
            options=SolverOptions(device=device, precision=kind, admm=admm),
        )
        for _ in range(5):
            run.step()
        results.append(run.placed()[0])
    assert np.abs(results[0] - results[1]).max() <= tolerance * shapes.extent(V)


def test_per_vertex_cubeness_and_orientation_equal_their_scalars(device):
    V, F = shapes.blob(2)
    setup = Setup(rest_mesh(V, F, PAPER))
    one = Stylization(setup, Style(0.3, Q), options=SolverOptions(device=device))
    many = Stylization(
        setup,
        Style(np.full(len(V), 0.3), np.tile(Q, (len(V), 1, 1))),
        options=SolverOptions(device=device),
    )
    for _ in range(4):
        one.step()
        many.step()
    np.testing.assert_allclose(
        one.placed()[0], many.placed()[0], atol=by_device(device, 1e-12, 1e-6)
    )


def test_an_update_never_worsens_the_rotations(device):
    rest = rest_mesh(*shapes.skewed_blob(), proxy=PAPER)
    step = local_step(rest, 0.7, device, max_iterations=1)
    U = deformed(rest.V)
    energies = [np.sum(step.update(U)) for _ in range(30)]
    assert np.diff(energies).max() <= by_device(device, 1e-12, 1e-5)
