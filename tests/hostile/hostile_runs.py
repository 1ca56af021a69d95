# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of the solver on broken meshes, and what holds for each of their results."""

import importlib.util

import numpy as np
from hostile_meshes import broken_meshes
from hostile_options import options_for
from hypothesis import strategies as st

import solver
from solver import Pose, Setup, SolverOptions, Style, Stylization, rest_mesh

ITERATIONS = 6
ROUNDING = 1e-9
"""of the energy at rest: what sums of 64 bit numbers may differ by, with cotangents up to 1e3"""
NOTHING = 1e-10
"""an energy in the unit box that is nothing but rounding, of up to 10,000 vertices of a proxy"""
HAS_ENGINE = any(map(importlib.util.find_spec, ("taichi", "quadrants")))
DEVICES = (*4 * ["cpu"], "numpy") if HAS_ENGINE else ("numpy",)  # NumPy is slower


@st.composite
def cases(draw):
    """Draw a mesh, options for it, and a device."""
    mesh = draw(broken_meshes())
    return mesh, draw(options_for(mesh)), draw(st.sampled_from(DEVICES))


def prepared(mesh, options):
    """Return the Setup of a mesh."""
    return Setup(rest_mesh(mesh.V, mesh.triangles, options.proxy), options.pinned)


def run(setup, options, device, *, keep_apart=True, **more):
    """Return the Result and the energies of its iterations, an array for each round.

    The links of a round of Keep Apart add to the energy, so only those of one can be compared. If
    it is off, there is one round, and the last energy is that of the result.
    """
    state = Stylization(
        setup,
        Style(options.cubeness, options.orientation),
        Pose(targets=options.targets),
        SolverOptions(keep_rotation=options.keep_rotation, device=device, **more),
    )
    energies, setups = [], []

    def note(s):
        if not setups or s.setup is not setups[-1]:
            setups.append(s.setup)
            energies.append([])
        energies[-1].append(s.energy.total)

    advanced = solver.Run(state, ITERATIONS, tolerance=1e-6, keep_apart=keep_apart)
    advanced.complete(note)
    result = advanced.result()
    if not (keep_apart and options.proxy.keep_apart):
        energies[-1].append(result.energy.total)
    return result, [np.array(each) for each in energies]


def check_result(mesh, options, result):
    """Check what holds for every Result."""
    V, n = mesh.V, len(mesh.V)
    assert result.positions.shape == (n, 3)
    assert np.isfinite(result.positions).all()
    assert np.isfinite(result.energy.total)
    R = result.rotations
    assert np.abs(R @ R.swapaxes(1, 2) - np.eye(3)).max() < 1e-6
    assert (np.linalg.det(R) > 0.0).all()
    free = np.setdiff1d(np.flatnonzero(mesh.loose), options.pinned)
    assert result.positions[free].tobytes() == V[free].tobytes()
    held = V if options.targets is None else options.targets
    assert result.positions[options.pinned].tobytes() == held[options.pinned].tobytes()
