# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever the mesh: a finite result that keeps what was promised, with an energy that falls."""

import importlib.util

import numpy as np
from budget import examples
from hostile_meshes import SEEDS, broken_meshes
from hypothesis import given
from hypothesis import strategies as st

import solver
from solver import PAPER, Pose, ProxyOptions, Setup, SolverOptions, Style, Stylization, rest_mesh

ITERATIONS = 6
ROUNDING = 1e-9
"""of the energy at rest: what sums of 64 bit numbers may differ by, with cotangents up to 1e3"""
NOTHING = 1e-10
"""an energy in the unit box that is nothing but rounding, of up to 10,000 vertices of a proxy"""
HAS_ENGINE = any(map(importlib.util.find_spec, ("taichi", "quadrants")))
DEVICES = (*4 * ["cpu"], "numpy") if HAS_ENGINE else ("numpy",)  # NumPy is slower
PROXIES = (
    PAPER,
    ProxyOptions(),
    ProxyOptions(solidity=0.0),
    ProxyOptions(detail=1.0, keep_pose=False, keep_apart=False),  # it is the slowest
    ProxyOptions(together=False, solidity=10.0, refine=False, keep_apart=False),
)
POSES = {
    "rest": lambda V, rng: None,
    "moved": lambda V, rng: V + 0.2 * np.ptp(V, axis=0).max() * rng.normal(size=V.shape),
    "collapsed": lambda V, rng: np.tile(V[0], (len(V), 1)),
    "far": lambda V, rng: V + 1e3 * np.ptp(V, axis=0).max(),
}


@examples(70)
@given(
    mesh=broken_meshes(),
    cubeness=st.sampled_from([0.4, 0.0, 1e-6, 1.0, 10.0]),
    is_map=st.booleans(),
    share=st.sampled_from([0.0, 0.1, 1.0]),
    pose=st.sampled_from(sorted(POSES)),
    keep_rotation=st.booleans(),
    is_accelerated=st.booleans(),
    proxy=st.sampled_from(PROXIES),
    device=st.sampled_from(DEVICES),
    seed=SEEDS,
)
def test_a_result_keeps_what_was_promised(
    mesh, cubeness, is_map, share, pose, keep_rotation, is_accelerated, proxy, device, seed
):
    rng, V, n = np.random.default_rng(seed), mesh.V, len(mesh.V)
    pinned = np.setdiff1d(np.flatnonzero(rng.random(n) < share), np.flatnonzero(~mesh.loose)[0])
    targets = POSES[pose](V, rng) if len(pinned) else None
    setup = Setup(rest_mesh(V, mesh.triangles, proxy), pinned)
    lam = cubeness * rng.choice([0.0, 0.5, 1.0], n) if is_map else cubeness
    options = SolverOptions(
        keep_rotation=keep_rotation, is_accelerated=is_accelerated, device=device
    )
    state = Stylization(setup, Style(lam), Pose(targets=targets), options)
    rounds = []

    def note(s):
        if not rounds or rounds[-1][0] is not s.setup:
            rounds.append((s.setup, []))  # with links of Keep Apart, which add to the energy
        rounds[-1][1].append(s.energy.total)

    run = solver.Run(state, ITERATIONS, tolerance=1e-6)
    run.complete(note)
    result = run.result()
    for _, energies in [] if is_accelerated else rounds:  # it may rise on the way
        assert np.diff(energies).max(initial=0.0) <= ROUNDING * abs(energies[0]) + NOTHING
    assert np.isfinite(result.positions).all() and np.isfinite(result.energy.total)
    R = result.rotations
    assert np.abs(R @ R.swapaxes(1, 2) - np.eye(3)).max() < 1e-6
    assert (np.linalg.det(R) > 0.0).all()
    free = np.setdiff1d(np.flatnonzero(mesh.loose), pinned)
    assert result.positions[free].tobytes() == V[free].tobytes()
    held = V if targets is None else targets
    assert result.positions[pinned].tobytes() == held[pinned].tobytes()
