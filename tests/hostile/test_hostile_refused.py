# SPDX-License-Identifier: GPL-3.0-or-later
"""What cannot be used is refused in one line that says why."""

import numpy as np
import pytest
from budget import examples
from hostile_meshes import SEEDS, broken_meshes
from hostile_runs import DEVICES
from hypothesis import given
from hypothesis import strategies as st

from solver import CubicCraftError, stylize


def _not_finite(arguments, rng):
    used = np.unique(arguments["F"])
    arguments["V"][rng.choice(used), rng.integers(3)] = rng.choice([np.nan, np.inf, -np.inf])


def _loose_not_finite(arguments, rng):
    arguments["V"] = np.concatenate([arguments["V"], [[0.0, np.nan, 0.0]]])


def _index_too_large(arguments, rng):
    arguments["F"][rng.integers(len(arguments["F"])), rng.integers(3)] = len(arguments["V"])


def _index_negative(arguments, rng):
    arguments["F"][rng.integers(len(arguments["F"])), rng.integers(3)] = -1


def _given(name, value):
    return lambda arguments, rng: arguments.update({name: value})


def _all_pinned(arguments, rng):
    arguments["pinned"] = np.arange(len(arguments["V"]))


def _pin_out_of_range(arguments, rng):
    arguments["pinned"] = [len(arguments["V"])]


def _target_not_finite(arguments, rng):
    arguments["pinned"], arguments["targets"] = [0], arguments["V"] * np.nan


def _map_too_short(arguments, rng):
    arguments["cubeness"] = np.ones(len(arguments["V"]) - 1)


SPOILT = {
    "not finite": _not_finite,
    "a loose vertex is not finite": _loose_not_finite,
    "index too large": _index_too_large,
    "index negative": _index_negative,
    "no faces": _given("F", np.empty((0, 3), int)),
    "cubeness nan": _given("cubeness", np.nan),
    "cubeness negative": _given("cubeness", -0.1),
    "cubeness infinite": _given("cubeness", np.inf),
    "map too short": _map_too_short,
    "all pinned": _all_pinned,
    "pin out of range": _pin_out_of_range,
    "target not finite": _target_not_finite,
    "mirroring": _given("orientation", -np.eye(3)),
    "orientation not finite": _given("orientation", np.full((3, 3), np.nan)),
    "sheared orientation": _given("orientation", np.triu(np.ones((3, 3)))),
    "no iterations": _given("max_iterations", 0),
    "tolerance nan": _given("tolerance", np.nan),
    "tolerance 0": _given("tolerance", 0.0),
    "unknown device": _given("device", "tpu"),
}
"""what a name stands for: a function that spoils the arguments of `stylize`"""


@examples(20)
@given(mesh=broken_meshes(), data=st.data())
def test_what_cannot_be_used_is_refused(mesh, data):
    spoil = data.draw(st.sampled_from(sorted(SPOILT)), label="spoilt")
    rng = np.random.default_rng(data.draw(SEEDS, label="seed"))
    arguments = {
        "V": mesh.V.copy(),
        "F": mesh.triangles,
        "device": data.draw(st.sampled_from(DEVICES)),
    }
    SPOILT[spoil](arguments, rng)
    with pytest.raises(CubicCraftError) as caught:
        stylize(**arguments)
    message = str(caught.value)
    assert message and "\n" not in message
