# SPDX-License-Identifier: GPL-3.0-or-later
"""Mirrors: partners, what is imposed, and the iteration under it."""

import numpy as np
import pytest
from devices import by_device
from shapes import sphere

from solver import (
    NO_PARTNER,
    PAPER,
    Mirror,
    Pose,
    ProxyOptions,
    Setup,
    SolverOptions,
    Stylization,
    commuting,
    partners,
    rest_mesh,
    run,
)

FLIP = np.diag([-1.0, 1.0, 1.0])


def mirror_of(V, axis=0, tolerance=1e-6):
    linear = np.eye(3)
    linear[axis, axis] = -1.0
    return Mirror(partners(V, V @ linear, tolerance), linear, np.zeros(3))


def lump():
    """Return a shape that is symmetric about X only, and its mirror."""
    V, F = sphere(4)
    axis = next(a for a in range(3) if mirror_of(V, a).count == len(V))
    V = np.roll(V, -axis, axis=1)
    V = V * (1 + 0.3 * np.cos(4 * V[:, :1]) * np.sin(2 * V[:, 1:2] + 1.3 * V[:, 2:] + 0.4))
    mirror = mirror_of(V)
    assert mirror.count == len(V)
    return V, F, mirror


def test_partners_are_mutual_and_within_the_tolerance():
    V = np.array([[1.0, 0, 0], [-1.001, 0, 0], [0, 2, 0], [3, 0, 0], [-3.1, 0, 0]])
    found = partners(V, V @ FLIP, 0.01)
    assert found.tolist() == [1, 0, 2, NO_PARTNER, NO_PARTNER]


def test_of_two_that_are_near_an_image_only_the_nearer_is_its_partner():
    V = np.array([[1.0, 0, 0], [-1, 0, 0], [-1.001, 0, 0], [0, 2, 0]])
    assert partners(V, V @ FLIP, 0.01).tolist() == [1, 0, NO_PARTNER, 3]


def test_of_vertices_at_one_place_the_first_belongs_to_the_first():
    V = np.array([[1.0, 0, 0], [-1, 0, 0], [1, 0, 0], [-1, 0, 0], [1, 0, 0], [0, 0, 0]])
    assert partners(V, V @ FLIP, 1e-6).tolist() == [1, 0, 3, 2, NO_PARTNER, 5]


def test_imposed_positions_are_images_bit_for_bit():
    rng = np.random.default_rng(1)
    V, _, mirror = lump()
    positions = (V + rng.normal(0, 0.1, V.shape)).astype(np.float32)
    mirror.impose(positions)
    flipped = positions * np.array([-1, 1, 1], np.float32)
    assert (positions[mirror.partner] == flipped).all()


def test_rotations_of_images_are_images():
    rng = np.random.default_rng(2)
    V, _, mirror = lump()
    rotations = np.linalg.qr(rng.normal(size=(len(V), 3, 3)))[0]
    rotations *= np.linalg.det(rotations)[:, None, None]
    mirror.impose_rotations(rotations)
    assert rotations[mirror.partner] == pytest.approx(FLIP @ rotations @ FLIP, abs=1e-12)
    assert np.linalg.det(rotations) == pytest.approx(1.0)


def test_pairs_that_spoil_another_plane_are_dropped():
    rng = np.random.default_rng(3)
    V, _ = sphere(3)
    mirrors = [mirror_of(V, axis, 1e-6) for axis in range(3)]
    lost = int(np.flatnonzero((mirrors[0].partner >= 0) & (np.abs(V).min(axis=1) > 0.1))[0])
    mirrors[0].partner[[lost, mirrors[0].partner[lost]]] = NO_PARTNER
    assert mirrors[1].partner[lost] != NO_PARTNER
    found = commuting(mirrors)
    positions = V + rng.normal(0, 0.1, V.shape)
    for mirror in found:
        mirror.impose(positions)
    assert found[0].count < mirrors[1].count
    for mirror in found:
        has_one = mirror.partner >= 0
        assert has_one.sum() > 0.9 * len(V)
        image = positions[mirror.partner[has_one]]
        assert (image == (positions @ mirror.linear)[has_one]).all()


@pytest.mark.parametrize("proxy", [PAPER, ProxyOptions()], ids=["paper", "default"])
def test_halves_stay_images_and_the_energy_falls(proxy, device):
    V, F, mirror = lump()
    setup = Setup(rest_mesh(V, F, proxy), mirrors=[mirror])
    state = Stylization(
        setup, 0.4, options=SolverOptions(device=device, is_accelerated=False, keep_rotation=True)
    )
    energies = []
    for _ in range(30):
        state.step()
        energies.append(state.energy.total)
    assert np.diff(energies).max() <= by_device(device, 1e-12, 1e-6)
    positions, _ = state.placed()
    assert np.abs(positions - V).max() > 0.05
    near = by_device(device, 1e-12, 1e-6)
    assert positions[mirror.partner] == pytest.approx(positions @ FLIP, abs=near)


def test_midpoints_of_a_refined_mesh_have_partners():
    V = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
    V *= [1.0, 0.9, 1.2]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    F = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    setup = Setup(rest_mesh(V, F, ProxyOptions()), mirrors=[mirror_of(V)])
    (mirror,) = setup.mirrors
    assert len(mirror.partner) > 100
    assert mirror.count > 0.9 * len(mirror.partner)
    has_one = mirror.partner >= 0
    rest = setup.rest.V
    assert mirror.image(rest)[has_one] == pytest.approx(rest[mirror.partner[has_one]], abs=1e-9)


def test_what_is_pinned_and_its_partner_are_free_of_each_other():
    V, F, mirror = lump()
    pinned = np.flatnonzero(V[:, 0] > 0.8)
    targets = V + [0.2, 0.0, 0.0]
    setup = Setup(rest_mesh(V, F, PAPER), pinned, mirrors=[mirror])
    result = run(Stylization(setup, 0.4, Pose(targets=targets), SolverOptions(device="numpy")), 50)
    assert (result.positions[pinned] == targets[pinned]).all()
    assert np.abs(result.positions[mirror.partner[pinned]] - targets[pinned] @ FLIP).max() > 0.05
