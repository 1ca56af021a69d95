# SPDX-License-Identifier: GPL-3.0-or-later
"""Hardening: sides become flat, edges straight, and what is to stay stays."""

from dataclasses import replace
from functools import cache

import numpy as np
import proxy_shapes
import pytest
import shapes
from facing import AXES, share_facing
from named_forms import POLYTOPES

from solver import (
    PAPER,
    FrameSequence,
    Mirror,
    Pose,
    ProxyOptions,
    Run,
    Setup,
    SolverOptions,
    Style,
    Stylization,
    partners,
    rest_mesh,
    run,
    stylize,
    triangle_areas_and_normals,
)
from solver.hardening.hard_stylization import HardStylization
from solver.hardening.hardening import DRAWN, OF_SHEETS, hold_of
from solver.hardening.sides import NO_SIDE
from solver.styles.forms import prism

KEPT = SolverOptions(keep_rotation=True, device="numpy")
PLAIN = SolverOptions(keep_rotation=True, device="numpy", is_accelerated=False)
ROUND = ("cylinder", "cone", "slab", "pillar")


def soft_blob(style, proxy=PAPER, pinned=(), options=KEPT, steps=15):
    """Return a Stylization of a blob, some steps on its way."""
    state = Stylization(Setup(rest_mesh(*shapes.blob(3), proxy), pinned), style, None, options)
    for _ in range(steps):
        state.step()
    state.finish()
    return state


@pytest.mark.parametrize("proxy", [PAPER, ProxyOptions(refine=False)], ids=["paper", "links"])
def test_the_energy_falls_in_every_step(proxy):
    hard = HardStylization(soft_blob(Style(0.6, crispness=1.0), proxy, options=PLAIN))
    energies = []
    for _ in range(20):
        hard.step()
        energies.append(hard.energy.total)
    assert (np.diff(energies) <= 1e-9).all()
    assert energies[-1] < 0.9 * energies[0]
    assert energies[-1] > 0.0


def test_the_energy_is_that_of_its_formula():
    hard = HardStylization(soft_blob(Style(0.6, crispness=1.0)))
    rest, target = hard.rest, hard.hardening.target
    hard.local_step()
    U, F, b = hard._motion.point, rest.F, 0.9
    R = hard._local.of_faces
    c, t, h = target.base.normals, target.directions, target.heights
    corners = rest.V[F]
    flat = corners + (h[F] - np.einsum("mkj,mj->mk", corners, c))[..., None] * c[:, None]
    arap = above = 0.0
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        w = rest.cotangents[:, k]
        rigid = np.einsum("mij,mj->mi", R, flat[:, j] - flat[:, i]) - (U[F[:, j]] - U[F[:, i]])
        arap += (w * (rigid**2).sum(axis=1)).sum() / 2
        off = ((U[F[:, j]] - U[F[:, i]]) * t).sum(axis=1) - (h[F[:, j]] - h[F[:, i]])
        above += (w * off**2).sum() / 2
    held = (target.hold * ((U - target.soft) ** 2).sum(axis=1)).sum()
    expected = 3 * (1 - b) * arap + 3 * b * above + 1.5 * held
    assert hard.energy.total == pytest.approx(expected, rel=1e-9)
    np.testing.assert_allclose(np.einsum("mij,mj->mi", R, c), t, atol=1e-9)


def test_another_target_is_gone_on_with_as_far_out():
    hard = HardStylization(soft_blob(Style(0.6, crispness=1.0)))
    for _ in range(5):
        hard.step()
    hard.give_back_volume()
    step, U = hard._local, hard._motion.positions
    other = step.go_on_with(hard.rest, hard.hardening.target)
    assert step.outward.max() > 1e-4
    np.testing.assert_array_equal(other.outward, step.outward)
    np.testing.assert_allclose(other.update(U)[0], step.update(U)[0], rtol=1e-12)


@pytest.mark.thorough(4)
@pytest.mark.parametrize("name", [name for name in POLYTOPES if name not in ROUND])
def test_a_ball_gets_the_sides_of_its_form(name):
    V, F = shapes.sphere(4)
    form = POLYTOPES[name]()
    directions = form.normals
    shares = [
        share_facing(run(state(form, crispness, V, F)).positions, F, directions, 6)
        for crispness in (0.0, 1.0)
    ]
    least = {"tetrahedron": 0.7, "pyramid": 0.79}.get(name, 0.88)
    assert shares[1] > least
    assert shares[1] > shares[0] - 0.04, "no side is less flat than it was"


def state(form, crispness, V, F):
    """Return a Stylization of a mesh."""
    style = Style(1.0, form=form, crispness=crispness)
    return Stylization(Setup(rest_mesh(V, F, PAPER)), style, options=KEPT)


@pytest.mark.parametrize("name", ROUND)
def test_the_round_part_of_a_form_stays_round(name):
    """So do walls that nothing draws to one side more than to others."""
    V, F = shapes.sphere(4)
    hard = HardStylization(soft_of(state(POLYTOPES[name](), 1.0, V, F)))
    side = hard.hardening.side
    _, normals = triangle_areas_and_normals(V, F)
    assert (side[np.abs(normals[:, 2]) < 0.3] == NO_SIDE).all() or name == "slab"
    assert (side[normals[:, 2] < -0.95] != NO_SIDE).all() or name == "pillar"


@pytest.mark.parametrize("sides", [(3, 6), (6, 4)])
def test_sides_of_another_form_follow_the_nearest_only(sides):
    """As where a form is keyed: the number of a side says nothing of the next form."""
    V, F = shapes.sphere(4)
    before, soft = (soft_of(state(prism(count), 1.0, V, F)) for count in sides)
    alone = HardStylization(soft).hardening
    after = HardStylization(soft, HardStylization(before).hardening.facing).hardening
    assert (alone.side == after.side).mean() > 0.8
    again = HardStylization(soft, alone.facing).hardening
    assert (alone.side == again.side).mean() > 0.98


def soft_of(state, steps=30):
    """Return a Stylization after some steps."""
    for _ in range(steps):
        state.step()
    state.finish()
    return state


def test_a_box_that_is_turned_away_stays_flat():
    """What is flat already is never bent: sides that lie between those of the form, too."""
    V, F = proxy_shapes.box((2, 1.5, 1))
    turn = np.array([[np.cos(0.6), -np.sin(0.6), 0], [np.sin(0.6), np.cos(0.6), 0], [0, 0, 1.0]])
    for proxy in (ProxyOptions(), ProxyOptions(keep_pose=False)):
        U = stylize(V @ turn.T, F, 0.4, proxy=proxy, keep_rotation=True, crispness=1.0).positions
        np.testing.assert_allclose(U, V @ turn.T, atol=1e-6)


@pytest.mark.parametrize("crispness", [0.3, 1.0])
def test_no_flat_side_of_a_rounded_box_becomes_less_flat(crispness):
    """The cushion of the complaint: sides that are flat at rest, with round edges."""
    V, F = shapes.sphere(4)
    V = np.clip(4.0 * V, -1.0, 1.0) * [1.0, 0.7, 0.4] + 0.2 * V
    before = share_facing(V, F, AXES, 6)
    U = stylize(V, F, 0.4, proxy=ProxyOptions(), keep_rotation=True, crispness=crispness).positions
    assert share_facing(U, F, AXES, 6) > before


def test_crispness_0_changes_nothing():
    V, F = shapes.blob(3)
    one, other = (
        stylize(V, F, 0.5, proxy=PAPER, device="numpy", **more)
        for more in ({}, {"crispness": 0.0, "detail_strength": 1.0})
    )
    assert one == other


def test_without_cubeness_the_shape_stays():
    V, F = shapes.blob(3)
    U = stylize(V, F, 0.0, proxy=ProxyOptions(), crispness=1.0, keep_rotation=True).positions
    np.testing.assert_allclose(U, V, atol=1e-9)


def test_what_is_hardly_drawn_to_its_form_is_less_crisp():
    states = (soft_blob(Style(value, crispness=1.0), steps=1) for value in (DRAWN / 4, 2 * DRAWN))
    found = [HardStylization(state).hardening.crispness.max() for state in states]
    assert found == pytest.approx([0.25, 1.0])


def test_open_sheets_are_held_by_their_size():
    rest = rest_mesh(*shapes.sheet(), ProxyOptions(refine=False))
    np.testing.assert_allclose(hold_of(rest), rest.areas / OF_SHEETS**2)


def test_what_is_held_stays_and_what_is_moved_goes_there():
    V, F = shapes.blob(3)
    pinned = np.flatnonzero(V[:, 2] < V[:, 2].min() + 0.5)
    targets = V + [0.1, 0, 0.2]
    setup = Setup(rest_mesh(V, F, ProxyOptions()), pinned)
    style = Style(0.6, crispness=1.0)
    result = run(Stylization(setup, style, Pose(targets=targets), KEPT))
    np.testing.assert_array_equal(result.positions[pinned], targets[pinned])


def test_halves_stay_mirror_images():
    V, F = shapes.sphere(3)
    V = V * [1.0, 0.8, 1.3]
    flip = np.diag([-1.0, 1.0, 1.0])
    mirror = Mirror(partners(V, V @ flip, 1e-6), flip, np.zeros(3))
    setup = Setup(rest_mesh(V, F, ProxyOptions()), mirrors=[mirror])
    U = run(Stylization(setup, Style(0.6, crispness=0.6), options=KEPT)).positions
    np.testing.assert_allclose(U[mirror.partner], U @ flip, atol=1e-12)


def test_a_share_is_between_the_soft_and_the_hard_shape():
    V, F = shapes.blob(3)
    soft, quarter, half, hard = (
        run(
            Stylization(Setup(rest_mesh(V, F, PAPER)), Style(0.6, crispness=c), options=KEPT)
        ).positions
        for c in (0.0, 0.25, 0.5, 1.0)
    )
    off = np.linalg.norm(quarter - 0.5 * (soft + half), axis=1)
    assert np.quantile(off, 0.8) < 1e-5, "but for borders, each of which is straight"
    assert off.max() < 0.07
    assert np.abs(hard - soft).max() > 0.02


@pytest.mark.parametrize("together", [False, True])
def test_another_crispness_has_the_end_of_a_new_run(together):
    setup = Setup(rest_mesh(*shapes.blob(3), ProxyOptions(refine=False, together=together)))
    first = Run(Stylization(setup, Style(0.5, crispness=0.2), options=KEPT))
    assert first.with_crispness(0.9) is None, "it has not begun"
    first.complete()
    later = first.with_crispness(0.9)
    later.complete()
    new = Run(Stylization(setup, Style(0.5, crispness=0.9), options=KEPT))
    new.complete()
    assert later.result() == new.result()
    assert first.with_crispness(0.0) is None, "other triangles have no side then"


@pytest.mark.parametrize(("thickness", "is_hardened"), [(0.004, False), (0.2, True)])
def test_what_is_thin_all_over_ends_with_the_soft_shape(thickness, is_hardened):
    V, F = proxy_shapes.torus(200, 8, thickness)
    done = Run(Stylization(Setup(rest_mesh(V, F)), Style(0.4, crispness=0.9), options=KEPT))
    done.complete()
    assert (done.hard is not None) == is_hardened


# -- details ---------------------------------------------------------------------------------------


def knobs():
    """Return a ball with low bumps, and which vertices are on top of one."""
    V, F = shapes.sphere(4)
    ways = np.array([[1.0, 0.1, 0.2], [0.1, 1.0, -0.2], [-0.2, 0.1, 1.0]])
    ways = np.concatenate([ways, -ways]) / np.linalg.norm(ways[0])
    near = np.linalg.norm(V[:, None] - ways[None], axis=2).min(axis=1)
    return V * (1.0 + 0.024 * np.exp(-((near / 0.1) ** 2)))[:, None], F, near


@cache
def with_details(strength, crispness):
    """Return the positions of the ball with its bumps this strong."""
    V, F, _ = knobs()
    return cubified(V, F, strength, crispness)


def cubified(V, F, strength, crispness):
    proxy, kept = replace(PAPER, detail=0.1), {"keep_rotation": True, "crispness": crispness}
    return stylize(V, F, 0.4, proxy=proxy, detail_strength=strength, **kept).positions


@pytest.mark.parametrize("crispness", [0.0, 1.0])
def test_details_are_as_high_as_they_are_asked_to_be(crispness):
    _, _, near = knobs()
    top, around = near < 0.04, (near > 0.26) & (near < 0.34)
    shown = []
    for strength in (0.0, 1.0, 2.0):
        U = with_details(strength, crispness)
        tops, rings = (np.linalg.norm(U[part], axis=1).mean() for part in (top, around))
        shown.append(tops - rings)
    assert shown[2] - shown[1] == pytest.approx(shown[1] - shown[0], rel=0.35)
    assert 0.006 < shown[1] - shown[0] < 0.04


def test_details_that_were_added_turn_with_the_shape():
    found = HardStylization(soft_blob(Style(0.6, crispness=1.0), steps=3)).hardening
    added = np.random.default_rng(0).normal(size=found.soft.shape)
    raised = found.solved + np.einsum("nij,nj->ni", found.rotations, added)
    spun = np.broadcast_to(shapes.rotation(x=40, y=-25), found.rotations.shape)
    later = replace(found, soft=raised).followed(found.solved + 1.0, spun)
    np.testing.assert_allclose(later.soft, found.solved + 1.0 + added @ spun[0].T, atol=1e-9)


def test_the_strength_of_details_can_be_painted():
    V, F, _ = knobs()
    U = cubified(V, F, np.where(V[:, 0] > 0, 1.0, 0.0), 1.0)
    for strength, part in ((1.0, V[:, 0] > 0.4), (0.0, V[:, 0] < -0.4)):
        np.testing.assert_allclose(U[part], with_details(strength, 1.0)[part], atol=4e-3)


def test_what_is_thinner_than_details_stays_soft():
    V, F = shapes.sphere(4)
    finger = V * [0.02, 0.02, 0.3] + [0, 0, 1.2]
    both, faces = proxy_shapes.joined((V, F), (finger, F))
    soft, hard = (
        stylize(both, faces, 0.4, proxy=ProxyOptions(), keep_rotation=True, crispness=c).positions
        for c in (0.0, 1.0)
    )
    moved = np.linalg.norm(hard - soft, axis=1)
    assert moved[len(V) :].max() < 0.2 * moved[: len(V)].max()


# -- frames ----------------------------------------------------------------------------------------


def test_frames_keep_their_sides():
    """A ball that turns by 40 degrees, in steps: each triangle changes its side once at most."""
    V, F = shapes.sphere(3)
    setup = Setup(rest_mesh(V, F, PAPER))
    sequence, sides = FrameSequence(setup.rest), []
    for angle in np.radians(np.arange(0, 41, 4)):
        turn = np.array(
            [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
        )
        frame = Stylization(setup.posed(V @ turn.T), Style(0.6, crispness=1.0), options=KEPT)
        result = sequence.solve(frame)
        sides.append(sequence.state.facing)
        assert share_facing(result.positions, F, AXES, 8) > 0.74
    changes = np.diff(np.array(sides), axis=0).any(axis=2).sum(axis=0)
    assert np.mean(changes > 1) < 0.02


def test_a_sequence_that_was_stopped_goes_on_alike():
    V, F = shapes.blob(2)
    setup = Setup(rest_mesh(V, F, PAPER))
    style = Style(0.6, crispness=0.7)

    def frames(sequence, heights):
        for height in heights:
            frame = Stylization(setup.posed(V * [1, 1, height]), style, options=KEPT)
            result = sequence.solve(frame)
        return result.positions

    whole = frames(FrameSequence(setup.rest), (1.0, 1.05, 1.1))
    stopped = FrameSequence(setup.rest)
    frames(stopped, (1.0, 1.05))
    np.testing.assert_array_equal(frames(FrameSequence(setup.rest, stopped.state), (1.1,)), whole)


def test_a_flat_roof_between_two_sides_is_not_bent():
    V, faces = proxy_shapes.house()
    F = np.array([[f[0], f[k], f[k + 1]] for f in faces for k in range(1, len(f) - 1)])
    U = stylize(V, F, 0.4, proxy=ProxyOptions(), keep_rotation=True, crispness=0.9).positions
    for roof in faces[-2:]:
        X = U[roof] - U[roof].mean(axis=0)
        assert np.linalg.svd(X)[1][2] < 0.02
