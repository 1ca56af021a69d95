# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects as pieces: placed, joined, solved together and split, without Blender."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from facing import AXES, share_facing
from shapes import blob, extent, rotation, sheet, sphere

from solver import (
    PAPER,
    CubicCraftError,
    HandlePose,
    ProxyOptions,
    SolverOptions,
    Style,
    flip,
    join_pieces,
    piece_of,
    run,
)
from solver.pieces.placement import placement_by
from solver.styles.forms import box, octahedron, prism

ROOT = Path(__file__).parents[3]


def solved(*pieces, proxy=PAPER, keep_floor=False, only_standing=False, **options):
    """Return the positions of each piece."""
    problem = join_pieces(pieces, proxy)
    options = SolverOptions(**{"keep_rotation": True, "device": "numpy"} | options)
    result = run(problem.stylization(options), 60)
    floor = {"keep_floor": keep_floor, "only_standing": only_standing}
    found = problem.split(result.positions, result.rotations, **floor)
    return [positions for positions, _ in found]


def matrix_of(linear=None, offset=(0.0, 0.0, 0.0)):
    matrix = np.eye(4)
    matrix[:3, :3] = np.eye(3) if linear is None else linear
    matrix[:3, 3] = offset
    return matrix


def test_regions_have_styles_of_their_own():
    V, F = sphere(3)
    is_top = V[:, 2] > 0.0
    shares = np.stack([~is_top, is_top], axis=1).astype(float)
    gem = Style(2.0, form=octahedron())
    piece = piece_of(V, F, Style(2.0), regions=[gem], region_shares=shares)
    (U,) = solved(piece)
    heights = V[F].mean(axis=1)[:, 2]
    top, low, facets = F[heights > 0.4], F[heights < -0.4], gem.form.normals
    assert share_facing(U, top, facets, 10) > 0.6 > share_facing(U, top, AXES, 10)
    assert share_facing(U, low, AXES, 10) > 0.6 > 0.4 > share_facing(U, low, facets, 10)


def test_a_half_with_its_mirror_is_half_of_the_whole():
    V, F = sphere(3)
    V = V * [1.0, 0.7, 1.2]
    keep = (V[F][:, :, 0] >= -1e-9).all(axis=1)
    used, place = np.unique(F[keep], return_inverse=True)
    half = piece_of(V[used], place.reshape(-1, 3), Style(0.6), mirrors=[flip(0)])
    assert half.solved == len(V)
    (U,) = solved(half)
    (W,) = solved(piece_of(V, F, Style(0.6)))
    np.testing.assert_allclose(U, W[used], atol=0.01 * extent(V))
    seam = np.abs(V[used][:, 0]) < 1e-6
    assert seam.any() and np.abs(U[seam, 0]).max() < 1e-6


def test_what_is_turned_in_the_world_is_turned_back_in_the_object():
    V, F = blob(2)
    turn = rotation(20.0, -30.0, 50.0)
    (U,) = solved(piece_of(V, F, matrix=matrix_of(turn, (3.0, -1.0, 2.0))))
    (W,) = solved(piece_of(V @ turn.T, F))
    np.testing.assert_allclose(U @ turn.T, W, atol=1e-4)


def test_a_mirrored_object_has_its_normals_outside():
    V, F = blob(2)
    piece = piece_of(V, F, matrix=np.diag([-1.0, 1, 1, 1]))
    a, b, c = (piece.V[piece.F[:, k]] for k in range(3))
    assert (a * np.cross(b, c)).sum() > 0.0
    (U,) = solved(piece)
    (W,) = solved(piece_of(V * [-1, 1, 1], F[:, ::-1]))
    np.testing.assert_allclose(U * [-1, 1, 1], W, atol=1e-4)


def test_objects_that_touch_are_solved_as_one():
    V, F = sphere(3)
    eye = 0.2 * V + [0.0, -1.05, 0.3]
    proxy = ProxyOptions(refine=False)
    head, rides = solved(piece_of(V, F, Style(1.0)), piece_of(eye, F, Style(0.0)), proxy=proxy)
    (still,) = solved(piece_of(eye, F, Style(0.0)), proxy=proxy)
    moved = rides.mean(axis=0) - eye.mean(axis=0)
    near = np.linalg.norm(V - eye.mean(axis=0), axis=1) < 0.3
    below = (head[near] - V[near]).mean(axis=0)
    assert np.linalg.norm(still - eye, axis=1).max() < 1e-5
    assert np.linalg.norm(moved - below) < 0.5 * np.linalg.norm(below)


def test_where_the_map_is_zero_the_bits_stay():
    V, F = blob(2)
    weights = (V[:, 2] > 0.4).astype(float)
    (U,) = solved(piece_of(V, F, Style(1.0), map_weights=weights, matrix=matrix_of(rotation(9.0))))
    np.testing.assert_array_equal(U[weights == 0.0], V[weights == 0.0])
    assert np.abs(U - V).max() > 0.01


@pytest.mark.parametrize("hold_rest", [False, True])
def test_a_handle_takes_its_vertices_and_the_far_end_follows_or_stays(hold_rest):
    V, F = sheet()
    V = V * [4.0, 1.0, 1.0]
    is_end = V[:, 0] > 3.7
    raised = matrix_of(offset=(0.0, 0.0, 0.5))
    handle = HandlePose(matrix=tuple(raised.ravel().tolist()))
    numbers = np.where(is_end, 0, -1)
    (U,) = solved(
        piece_of(V, F, Style(0.1), handles=[handle], handle_of=numbers, hold_rest=hold_rest)
    )
    np.testing.assert_allclose(U[is_end], V[is_end] + [0.0, 0.0, 0.5], atol=1e-6)
    far = np.abs((U - V)[V[:, 0] < 0.5, 2]).mean()
    assert far < 0.1 if hold_rest else far > 0.3


def test_what_stands_on_the_floor_stays_there():
    V, F = blob(2)
    hat = 0.4 * V + [0.0, 0.0, 4.0]
    both = np.concatenate([V, hat]), np.concatenate([F, F + len(V)])
    free, kept = (solved(piece_of(*both, Style(1.0)), keep_floor=on)[0] for on in (False, True))
    low = V[:, 2].min()
    assert abs(free[: len(V), 2].min() - low) > 0.01
    assert abs(kept[: len(V), 2].min() - low) < 1e-5
    np.testing.assert_array_equal(free[len(V) :], kept[len(V) :])


def test_what_is_held_is_not_put_on_the_floor():
    V, F = blob(2)
    held = np.where(V[:, 2] > V[:, 2].max() - 0.3, 0, -1)
    piece = piece_of(V, F, Style(1.0), handles=[HandlePose()], handle_of=held)
    free, kept = (solved(piece, keep_floor=on)[0] for on in (False, True))
    assert abs(free[:, 2].min() - V[:, 2].min()) > 0.01
    np.testing.assert_array_equal(free, kept)


def test_a_seat_between_legs_that_stand_sinks_back_with_them():
    V, F = sphere(3)
    body = 0.7 * V + [0.0, 0.0, 0.75]
    legs = [0.22 * V * [1.0, 2.4, 1.0] + [side, -0.6, 0.24] for side in (-0.42, 0.42)]
    faces = np.concatenate([F, F + len(V), F + 2 * len(V)])
    piece = piece_of(np.concatenate([body, *legs]), faces, Style(0.4))
    proxy = ProxyOptions(refine=False)
    free, kept = (solved(piece, proxy=proxy, keep_floor=on)[0] for on in (False, True))
    parts = np.repeat(np.arange(3), len(V))
    for part, rest in enumerate([body, *legs]):
        assert free[parts == part, 2].min() > rest[:, 2].min() + 0.02
        assert abs(kept[parts == part, 2].min() - rest[:, 2].min()) < 0.005


def test_what_has_not_changed_is_used_again():
    V, F = blob(2)
    first = join_pieces([piece_of(V, F, Style(0.2))], PAPER)
    other = join_pieces([piece_of(V, F, Style(0.8))], PAPER, [first])
    assert other.setup is first.setup
    pinned = np.where(np.arange(len(V)) < 3, 0, -1)
    held = join_pieces([piece_of(V, F, handles=[HandlePose()], handle_of=pinned)], PAPER, [first])
    assert held.setup is not first.setup and held.setup.rest is first.setup.rest
    moved = join_pieces([piece_of(V + 0.1, F)], PAPER, [first])
    assert moved.setup.rest is not first.setup.rest


def test_a_message_names_the_objects():
    V, F = blob(1)
    pinned = {"handles": [HandlePose()], "handle_of": np.zeros(len(V), int)}
    pieces = [piece_of(V, F, name=name, **pinned) for name in ("Head", "Hat")]
    with pytest.raises(CubicCraftError, match=r'^"Head" and "Hat": all vertices are pinned'):
        join_pieces(pieces, PAPER)


HALVES = np.full((42, 2), 0.5)
OF_PIECE = {
    "handle_of": ({"handle_of": [0]}, r"handle_of must be an array of shape \(42,\), not \(1,\)"),
    "a handle": ({"handles": HandlePose()}, "handles must be a list, even of one"),
    "no handle": ({"handles": [np.eye(4)]}, "handles must be of the type HandlePose"),
    "map": ({"map_weights": [1.0]}, "map_weights must be an array of shape"),
    "map below 0": ({"map_weights": -1}, "map_weights must be finite and not negative"),
    "text": ({"detail_weights": "x"}, "detail_weights must be real numbers, not text"),
    "shares alone": ({"region_shares": HALVES}, "region_shares needs regions, a list of styles"),
    "regions alone": ({"regions": [Style(1)]}, r"regions need region_shares, .* \(42, 2"),
    "a region": ({"regions": Style(1)}, "regions must be a list, even of one"),
    "shares": (
        {"regions": [Style(1)], "region_shares": HALVES[:, 0]},
        r"region_shares must be an array of shape \(42, 2\), not \(42,\)",
    ),
    "sums": (
        {"regions": [Style(1)], "region_shares": 1.8 * HALVES},
        "each row of region_shares must add up to 1, without negative ones; divide by the sums",
    ),
    "matrix": ({"matrix": np.eye(3)}, "matrix must be 4x4 finite numbers"),
    "flat": ({"matrix": np.diag([1, 1, 0, 1])}, "a scale is zero; give another one"),
    "a mirror": ({"mirrors": flip(0)}, "mirrors must be a list, even of one"),
    "an axis": ({"mirrors": [0]}, "mirrors must be of the type Reflection, not int"),
    "symmetry": ({"symmetry": True}, "symmetry must be True or False for each of the three axes"),
    "style": ({"style": 0.4}, "style must be of the type Style, not float"),
    "masked": ({"map_weights": np.ma.masked_less(np.arange(42), 3)}, "must have no masked values"),
}


@pytest.mark.parametrize("name", OF_PIECE)
def test_what_makes_no_sense_in_a_piece_is_refused(name):
    options, words = OF_PIECE[name]
    with pytest.raises(CubicCraftError, match=words):
        piece_of(*blob(1), **options)


def test_what_makes_no_sense_in_a_problem_is_refused():
    V, F = blob(1)
    piece = piece_of(V, F)
    for call, words in (
        (lambda: join_pieces([]), "pieces must have at least one Piece"),
        (lambda: join_pieces([V]), "pieces must be of the type Piece, not float64"),
        (lambda: join_pieces([piece], 0.3), "proxy must be of the type ProxyOptions, not float"),
        (lambda: join_pieces([piece], PAPER, [3]), "earlier must be of the type Problem, not int"),
        (lambda: join_pieces([piece], PAPER).split(V[:5], None), r"shape \(42, 3\), as a Result"),
        (lambda: HandlePose(matrix=(1, 2)), "the matrix of a handle must be 4x4 finite numbers"),
        (lambda: HandlePose(is_cubic="yes"), "is_cubic must be True or False"),
        (lambda: flip(3), "an axis must be 0, 1 or 2, not 3"),
        (lambda: prism(5.5), "the number of sides of a form must be a whole number of at least 3"),
        (lambda: box([1, 1]), "the weights of a box must be three numbers"),
    ):
        with pytest.raises(CubicCraftError, match=words):
            call()


def test_pieces_and_problems_print_in_a_line():
    piece = piece_of(*blob(1), name="Head")
    assert repr(piece) == "Piece(name='Head', vertices=42, triangles=80)"
    problem = join_pieces([piece], PAPER)
    assert repr(problem) == "Problem(name='\"Head\"', vertices=42, triangles=80, components=1)"


def test_a_handle_takes_its_matrix_as_an_array():
    raised = np.eye(4)
    raised[2, 3] = 0.5
    assert HandlePose(matrix=raised) == HandlePose(matrix=tuple(raised.ravel().tolist()))
    assert not HandlePose(matrix=np.eye(4)).is_moved


@pytest.mark.parametrize(("number", "named"), [(2, "0 to 2"), (-2, "-2 to 0")])
def test_a_handle_that_is_not_there_is_refused(number, named):
    V, F = blob(1)
    handle_of = np.zeros(len(V), int)
    handle_of[7] = number
    with pytest.raises(CubicCraftError, match=f"refers to handles {named}, but there are only 2"):
        piece_of(V, F, handles=[HandlePose(), HandlePose()], handle_of=handle_of)
    handle_of[7] = -1
    assert piece_of(V, F, handles=[HandlePose()], handle_of=handle_of).is_held.sum() == len(V) - 1


@pytest.mark.parametrize(
    "style",
    [
        Style(np.full(42, 0.4)),
        Style(0.4, np.tile(np.eye(3), (42, 1, 1))),
        Style(0.4, form=[octahedron(), octahedron()], form_of=np.zeros(42, int)),
    ],
)
def test_a_style_that_differs_from_vertex_to_vertex_is_refused(style):
    V, F = blob(1)
    shares = np.tile([0.5, 0.5], (len(V), 1))
    with pytest.raises(CubicCraftError, match="style must be the same for all vertices"):
        piece_of(V, F, style)
    with pytest.raises(CubicCraftError, match="regions must be the same for all vertices"):
        piece_of(V, F, regions=[style], region_shares=shares)


def test_a_placement_by_a_matrix_leads_there_and_back():
    matrix = matrix_of(rotation(10.0, 20.0, 30.0) @ np.diag([2.0, 1.0, 0.5]), (1.0, 2.0, 3.0))
    placement = placement_by(matrix, (Style(0.4),))
    points = np.random.default_rng(1).normal(size=(20, 3))
    there = placement.place(points)
    np.testing.assert_allclose(there, points @ matrix[:3, :3].T + matrix[:3, 3])
    np.testing.assert_allclose(placement.read_back(there), points)
    np.testing.assert_allclose(placement.turn @ placement.stretch, placement.linear, atol=1e-12)


def test_the_room_loads_no_scipy_when_it_is_imported():
    modules = [path.stem for path in (ROOT / "solver" / "pieces").glob("*.py")]
    imports = "; ".join(f"import solver.pieces.{name}" for name in modules if name != "__init__")
    script = f"{imports}; import sys; print([m for m in sys.modules if m.startswith('scipy')])"
    words = [sys.executable, "-c", script]
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def table(heights=(1.0, 1.0, 1.0, 1.0), width=1.0):
    """Return a slab on four rounded legs, which go down to minus some heights."""
    rows, F, n = [], [], 0
    for x, y, height in zip((-1, 1, -1, 1), (-1, -1, 1, 1), heights, strict=True):
        V, G = blob(2)
        V = (V - V.mean(axis=0)) / np.ptp(V, axis=0)
        rows.append(V * [0.3, 0.3, height] + [0.6 * x, 0.6 * y, -0.5 * height])
        F.append(G + n)
        n += len(V)
    V, G = sphere(4)
    rows.append(np.clip(V, -0.6, 0.6) / 0.6 * [width, width, 0.15])
    return np.concatenate(rows), np.concatenate([*F, G + n])


@pytest.mark.thorough(1)
@pytest.mark.parametrize("width", [4.0, 1.0])
def test_all_legs_of_what_stands_come_back_to_the_floor(width):
    V, F = table(width=width)
    piece = piece_of(V, F, Style(0.8, crispness=0.9))
    free, kept = (
        solved(piece, proxy=ProxyOptions(), keep_floor=on, only_standing=True)[0]
        for on in (False, True)
    )
    size, n = np.ptp(V[:, 2]), len(blob(2)[0])
    legs = [slice(k * n, (k + 1) * n) for k in range(4)]
    rises = [[U[leg, 2].min() - V[leg, 2].min() for leg in legs] for U in (free, kept)]
    assert np.abs(rises[0]).max() > 0.006 * size
    assert np.abs(rises[1]).max() < 1e-3 * size
    assert np.abs(kept - free)[:, :2].max() == 0.0


def test_all_roots_of_a_stump_come_back_to_the_floor():
    V, F = sphere(4)
    angle = np.arctan2(V[:, 1], V[:, 0])
    long = 1.0 + np.cos(angle - 0.6) * np.cos(4 * angle)
    V = np.maximum(V * np.stack([long, long, np.full(len(V), 1.3)], axis=1), [-9.0, -9.0, -0.5])
    arch = np.maximum(1.0 - np.hypot(V[:, 0], V[:, 1]) / 0.9, 0.0)
    V[:, 2] += np.where(V[:, 2] <= -0.5, 0.08 * arch, 0.0)
    piece = piece_of(V, F, Style(0.8, crispness=0.9))
    (U,) = solved(piece, proxy=ProxyOptions(), keep_floor=True, only_standing=True)
    size, root = np.ptp(V[:, 2]), np.round(angle / (np.pi / 2)).astype(int) % 4
    is_low = V[:, 2] < V[:, 2].min() + 0.01 * size
    rises = [U[is_low & (root == k), 2].min() - V[:, 2].min() for k in range(4)]
    assert np.abs(rises).max() < 0.005 * size


def test_a_ground_stays_where_it_is_under_what_stands_on_it():
    V, F = table()
    corners = np.array([(-8.0, -8.0), (8.0, -8.0), (8.0, 8.0), (-8.0, 8.0)])
    plane = np.column_stack([corners, np.full(4, V[:, 2].min())])
    ground = piece_of(plane, np.array([(0, 1, 2), (0, 2, 3)]), Style(0.8))
    found = solved(piece_of(V, F, Style(0.8)), ground, proxy=ProxyOptions(), keep_floor=True)
    assert np.abs(found[1] - plane).max() < 1e-9
    assert found[0][:, 2].min() == pytest.approx(plane[0, 2], abs=1e-6)
