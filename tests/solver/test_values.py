# SPDX-License-Identifier: GPL-3.0-or-later
"""What the solver returns can be compared, printed and pickled."""

import pickle

import numpy as np
import pytest
import shapes

from solver import (
    PAPER,
    Frames,
    FrameSequence,
    Mirror,
    Pose,
    ProxyOptions,
    Setup,
    SolverOptions,
    Style,
    Stylization,
    flatten_facets,
    rest_mesh,
    run,
    stylize,
)
from solver.styles import forms

V, F = shapes.blob(1)
AXES = np.concatenate([np.eye(3), -np.eye(3)])
ZERO = np.zeros(len(V), int)
TURNS = np.tile([0.0, 0, 0, 1], (5, 1, 1))
WEIGHTS = [np.where(V[:, 0] > 0.3, 1.0, 0.0)]


def setup(height=1.0, pinned=(0,)):
    return Setup(rest_mesh(V * [1, 1, height], F, ProxyOptions(refine=False)), pinned)


def stylization(cubeness=0.4):
    return Stylization(
        setup(),
        Style(cubeness),
        options=SolverOptions(device="numpy"),
    )


def state(steps=2):
    sequence = FrameSequence(rest_mesh(V, F, PAPER))
    sequence.solve(
        Stylization(Setup(rest_mesh(V, F, PAPER)), 0.4, options=SolverOptions(device="numpy")),
        steps,
    )
    return sequence.state


MADE = {
    "result": (
        lambda: stylize(V, F, 0.4, device="numpy", proxy=PAPER),
        lambda: stylize(V, F, 0.2, proxy=PAPER),
    ),
    "rest": (lambda: rest_mesh(V, F, PAPER), lambda: rest_mesh(2.0 * V, F, PAPER)),
    "proxy": (lambda: setup().rest, lambda: rest_mesh(V, F, PAPER)),
    "setup": (setup, lambda: setup(1.1)),
    "pins": (setup, lambda: setup(pinned=(1,))),
    "holds": (lambda: setup().with_holds(WEIGHTS), setup),
    "stylization": (stylization, lambda: stylization(0.2)),
    "options": (lambda: SolverOptions(device="numpy"), SolverOptions),
    "pose": (
        lambda: Pose(targets=V, hold_matrices=[np.eye(4)]),
        lambda: Pose(targets=2.0 * V, hold_matrices=[np.eye(4)]),
    ),
    "style": (
        lambda: Style(V[:, 0], form=["cube", "octahedron"], form_of=ZERO),
        lambda: Style(V[:, 0], form=["cube", "icosahedron"], form_of=ZERO),
    ),
    "limbs": (lambda: setup().rest.limbs, lambda: setup(3.0).rest.limbs),
    "mirror": (
        lambda: Mirror(np.arange(42), np.eye(3), np.zeros(3)),
        lambda: Mirror(np.arange(42), np.eye(3), np.ones(3)),
    ),
    "facets": (
        lambda: flatten_facets(V, F, AXES, 0.9, 0.2),
        lambda: flatten_facets(V, F, AXES, 0.9, 0.1),
    ),
    "frames": (
        lambda: Frames(np.zeros((5, 1, 3)), TURNS, np.ones((5, 1, 3))),
        lambda: Frames(np.zeros((5, 1, 3)), TURNS, np.zeros((5, 1, 3))),
    ),
    "state": (state, lambda: state(3)),
    "form": (forms.octahedron, forms.icosahedron),
}


@pytest.mark.parametrize("name", MADE)
def test_values_compare_print_and_pickle(name):
    make, make_other = MADE[name]
    one, same, other = make(), make(), make_other()
    assert one == same
    assert not (one != same)  # noqa: SIM202 - tuples have an operator of their own for this
    assert one != other and one != name and other not in (one, same)
    assert len(repr(one)) < 1500 and "\n" not in repr(one)
    assert repr(one).startswith(type(one).__name__)
    stored = pickle.loads(pickle.dumps(one))
    assert stored == one and stored != other


def test_a_new_stylization_runs_as_the_one_that_was_pickled():
    state = stylization()
    assert run(pickle.loads(pickle.dumps(state))) == run(state)


def test_one_that_has_begun_goes_on_from_its_shape():
    state = stylization()
    for _ in range(5):
        state.step()
    stored = pickle.loads(pickle.dumps(state))
    assert stored.iterations == 5 and np.array_equal(stored.placed()[0], state.placed()[0])
    assert run(stored).energy.total == pytest.approx(run(state).energy.total, rel=1e-3)


def test_held_groups_are_held_where_a_setup_is_read():
    held = setup().with_holds(WEIGHTS)
    assert "held_groups=1" in repr(held)
    matrix = np.eye(4)
    matrix[2, 3] = 0.2
    results = [
        run(Stylization(each, 0.4, Pose(hold_matrices=[matrix]), SolverOptions(device="numpy")), 20)
        for each in (held, pickle.loads(pickle.dumps(held)))
    ]
    assert results[0] == results[1]
