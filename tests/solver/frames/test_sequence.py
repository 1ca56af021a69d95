# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames that are solved one after the other: each exact, from the one before, and steadily."""

import numpy as np
import pytest
from shapes import blob, rotation, sheet

from solver import (
    PAPER,
    FrameSequence,
    Pose,
    ProxyOptions,
    Setup,
    SolverOptions,
    Stylization,
    rest_mesh,
    run,
)
from solver.frames.steadiness import (
    MOST_JUMPS,
    WIDTHS,
    Frames,
    Jumps,
    Motion,
    frame_of,
    least_width,
)

PROXIES = [ProxyOptions(), ProxyOptions(solidity=0.5, refine=False)]


def bent(V, angle):
    """Bend a shape about y by an angle over its height."""
    z = V[:, 2] - V[:, 2].min()
    radius = z.max() / max(angle, 1e-9)
    turn = z / radius
    return np.column_stack(
        [radius - np.cos(turn) * (radius - V[:, 0]), V[:, 1], np.sin(turn) * (radius - V[:, 0])]
    )


def bending(V, count, angle=1.0):
    return np.array([bent(V, angle * np.sin(np.pi * f / count)) for f in range(count)])


def turning(V, count, angle=30.0):
    return np.array([V @ rotation(z=angle * f / count).T for f in range(count)])


def solved(setup, sequence, frames, cubeness=0.4, pose=None, **options):
    """Yield the Result of each frame."""
    for V in frames:
        yield sequence.solve(Stylization(setup.posed(V), cubeness, pose, SolverOptions(**options)))


def recorded(frames, F, **options):
    """Solve all frames; return them as `Frames`."""
    setup = Setup(rest_mesh(frames[0], F, PAPER))
    sequence = FrameSequence(setup.rest)
    results = solved(setup, sequence, frames, keep_rotation=True, **options)
    pairs = zip(frames, results, strict=True)
    found = [frame_of(V, sequence.turns, result.positions) for V, result in pairs]
    return Frames(*(np.concatenate(values) for values in zip(*found, strict=True)))


def draping(count, size=17):
    """Return a square sheet that comes to hang over a ball, (count,n,3), and its triangles."""
    V, F = sheet(size)
    x, y = 2.0 * V[:, :2].T - 1.0
    distance, direction = np.hypot(x, y), np.arctan2(y, x)
    frames = []
    for radius in 0.6 / np.linspace(1e-3, 1.0, count):
        angle = np.minimum(distance / radius, np.pi / 2)
        out, down = radius * np.sin(angle), radius * (1.0 - np.cos(angle))
        down = down + distance - radius * angle  # the rest hangs
        frames.append(np.column_stack([out * np.cos(direction), out * np.sin(direction), -down]))
    return np.array(frames), F


@pytest.mark.parametrize("proxy", PROXIES)
def test_the_same_pose_is_the_same_setup(proxy):
    V, F = blob()
    V[3] = V[4]  # two that are welded
    setup = Setup(rest_mesh(V, F, proxy), [0, 1])
    posed = setup.posed(V)
    for name in ("V", "areas", "normals"):
        np.testing.assert_array_equal(getattr(posed.rest, name), getattr(setup.rest, name))
    for name in ("laplacian", "gather", "scatter", "indices"):
        mine, theirs = (getattr(s.rest.matrices, name) for s in (posed, setup))
        np.testing.assert_array_equal(mine, theirs)


@pytest.mark.thorough(2)
@pytest.mark.parametrize("proxy", PROXIES)
def test_at_cubeness_zero_each_frame_is_the_input(proxy, device):
    V, F = blob()
    frames = bending(V, 4)
    setup = Setup(rest_mesh(frames[0], F, proxy))
    results = solved(
        setup, FrameSequence(setup.rest), frames, 0.0, device=device, keep_rotation=True
    )
    for result, frame in zip(results, frames, strict=True):
        np.testing.assert_allclose(result.positions, frame, atol=2e-5)


@pytest.mark.thorough
def test_a_sheet_that_falls_over_a_ball_does_not_stay_flat():
    frames, F = draping(30)
    setup = Setup(rest_mesh(frames[0], F, ProxyOptions()))
    *_, last = solved(setup, FrameSequence(setup.rest), frames, device="numpy", keep_rotation=True)
    alone = run(
        Stylization(
            Setup(rest_mesh(frames[-1], F, ProxyOptions())),
            0.4,
            options=SolverOptions(device="numpy"),
        )
    )
    heights = [np.ptp(positions[:, 2]) for positions in (last.positions, alone.positions)]
    assert heights[0] > 0.85 * heights[1]


def test_nothing_accumulates_while_a_coat_turns_to_and_fro():
    """Else it is left with pleats where its corners were."""
    angles = 2.0 * np.pi * np.arange(432) / 432
    heights = np.linspace(-0.55, 0.55, 10)
    V = np.array([(0.5 * np.cos(a), 0.5 * np.sin(a), z) for z in heights for a in angles])
    i, j = np.meshgrid(np.arange(432), np.arange(9))
    a, b = (j * 432 + i).ravel(), (j * 432 + (i + 1) % 432).ravel()
    F = np.concatenate([np.stack([a, b, b + 432], 1), np.stack([a, b + 432, a + 432], 1)])
    frames = [V @ rotation(z=14.3 * np.cos(np.pi * f / 10)).T for f in range(7)]
    setup = Setup(rest_mesh(frames[0], F, ProxyOptions()))
    results = list(solved(setup, FrameSequence(setup.rest), frames, keep_rotation=True))
    alone = run(
        Stylization(setup.posed(frames[-1]), 0.4, options=SolverOptions(keep_rotation=True))
    )
    assert results[-1].energy.total < 1.06 * alone.energy.total


def test_what_is_pinned_stays_in_its_place_in_each_frame():
    V, F = blob()
    pinned = np.flatnonzero(V[:, 2] < -0.5)
    frames = turning(V, 4)
    setup = Setup(rest_mesh(frames[0], F, PAPER), pinned)
    results = solved(setup, FrameSequence(setup.rest), frames)
    for result, frame in zip(results, frames, strict=True):
        np.testing.assert_array_equal(result.positions[pinned], frame[pinned])


def test_groups_keep_their_place_in_each_frame():
    V, F = blob()
    weights = (V[:, 2] > 0.3).astype(float)
    setup = Setup(rest_mesh(V, F, PAPER)).with_holds([weights])
    frames = V + np.array([[[0.0, 0, 0]], [[0.5, 0, 0]]])
    sequence = FrameSequence(setup.rest)
    held = Pose(hold_matrices=[np.eye(4)])
    one, other = (r.positions for r in solved(setup, sequence, frames, pose=held))
    share = weights / weights.sum()
    np.testing.assert_allclose(share @ one, share @ frames[0], atol=2e-2)
    np.testing.assert_allclose(share @ other - share @ one, [0.5, 0, 0], atol=2e-2)


def test_a_sequence_continues_bit_for_bit_from_its_state():
    V, F = blob()
    frames = bending(V, 4)
    setup = Setup(rest_mesh(frames[0], F, ProxyOptions()))
    whole = list(solved(setup, FrameSequence(setup.rest), frames))
    first = FrameSequence(setup.rest)
    list(solved(setup, first, frames[:2]))
    fresh = Setup(rest_mesh(frames[0], F, ProxyOptions()))
    rest = list(solved(fresh, FrameSequence(fresh.rest, first.state), frames[2:]))
    for one, other in zip(whole[2:], rest, strict=True):
        np.testing.assert_array_equal(one.positions, other.positions)


@pytest.mark.parametrize("move", [bending, turning])
def test_no_vertex_jumps_more_than_three_times_as_far_as_in_the_input(move):
    V, F = blob()
    frames = recorded(move(V, 30), F)
    width, ratios = least_width(lambda: [frames])
    assert max(ratios) <= MOST_JUMPS
    inputs, jumps = Motion(), Jumps()
    inputs.add(frames.inputs)
    results = frames.results(width)
    jumps.add(results)
    assert np.allclose(jumps.over(inputs), ratios)
    far = np.abs(results - frames.inputs).max()
    assert far > 0.02, "it is hardly cubic"


def test_it_is_not_smoothed_more_than_needed():
    rng = np.random.default_rng(1)
    steps = np.cumsum(rng.normal(size=(20, 5, 3)), axis=0)
    turns = np.tile([0.0, 0, 0, 1], (20, 5, 1))
    assert least_width(lambda: [Frames(steps, turns, np.zeros_like(steps))]) == (0.0, (1.0, 1.0))
    noisy = Frames(steps, turns, 9.0 * rng.normal(size=(20, 5, 3)))
    width, ratios = least_width(lambda: [noisy])
    assert 0.0 < width < WIDTHS[-1] and max(ratios) <= MOST_JUMPS
    before = WIDTHS[WIDTHS.index(width) - 1]
    jumps, inputs = Jumps(), Motion()
    jumps.add(noisy.results(before))
    inputs.add(steps)
    assert max(jumps.over(inputs)) > MOST_JUMPS


def jumping(inputs, sizes):
    """Return `Frames` whose vertices jump by about these sizes, (f,1,1) or one for all."""
    offsets = np.random.default_rng(3).uniform(-0.25, 0.25, size=inputs.shape) * sizes
    return Frames(inputs, np.tile([0.0, 0, 0, 1], (*inputs.shape[:2], 1)), offsets)


@pytest.mark.parametrize("speed", [1.0, 1e-3, 1e-7])
def test_what_moves_evenly_is_not_smoothed_for_jumps_that_nobody_sees(speed):
    points = np.random.default_rng(4).uniform(-1.0, 1.0, size=(50, 3))
    points[:, 0] += 1.0  # so that it grows along x, and vertices have different speeds
    steps = speed * np.arange(24.0)[:, None, None] * points * [1.0, 0.0, 0.0]
    inputs = (points + steps).astype(np.float32).astype(np.float64)
    assert least_width(lambda: [jumping(inputs, max(0.1 * speed, 1e-5))])[0] == 0.0
    width, ratios = least_width(lambda: [jumping(inputs, max(speed, 1e-4))])
    assert 0.0 < width < WIDTHS[-1] and max(ratios) <= MOST_JUMPS


def test_what_is_at_rest_stays_the_same_bit_for_bit():
    rng = np.random.default_rng(2)
    inputs, offsets = rng.normal(size=(2, 1, 50, 3))
    quaternions = rng.normal(size=(1, 50, 4))
    frames = Frames(*(np.repeat(x, 30, axis=0) for x in (inputs, quaternions, offsets)))
    for width in WIDTHS:
        results = frames.results(width)
        assert (results == results[0]).all()


def test_pieces_of_the_vertices_give_the_same_as_all_at_once():
    V, F = blob()
    frames = recorded(turning(V, 10), F)

    def pieces():
        for begin in range(0, len(V), 100):
            yield Frames(*(values[:, begin : begin + 100] for values in frames))

    assert least_width(pieces) == least_width(lambda: [frames])
