# SPDX-License-Identifier: GPL-3.0-or-later
"""What holds for results of every kind."""

import itertools

import numpy as np
import pytest
from previewed import show_some
from results import COPIED, RESULTS, write
from rich_mesh import cubic_like, points_of
from snapshot import POSITIONS, SHAPE_KEY_POINTS, STORED, differences, snapshot_object, unchanged
from world import block_names


@pytest.mark.parametrize("result", RESULTS)
def test_restore_gives_all_bits_back(bridge, cubify, monkey, result):
    before, blocks = snapshot_object(monkey), block_names()
    made = [cubify(monkey, result, seed) for seed in (1, 2, 3)][-1]
    assert bridge.has_original(made.data)
    bridge.restore(made)
    assert not bridge.has_original(made.data)
    if result == "NEW_OBJECT":
        assert differences(before, snapshot_object(made), ignore=COPIED) == []
    else:
        assert differences(before, snapshot_object(monkey)) == []
        assert block_names() == blocks


@pytest.mark.parametrize("result", RESULTS)
def test_save_and_load(bridge, cubify, monkey, result, reopen):
    before = snapshot_object(monkey)
    made = cubify(monkey, result)
    written = snapshot_object(made)
    loaded = reopen(made.name)
    assert differences(written, snapshot_object(loaded)) == []
    bridge.restore(loaded)
    ignore = COPIED if result == "NEW_OBJECT" else ()
    assert differences(before, snapshot_object(loaded), ignore=(*ignore, "selected")) == []


@pytest.mark.parametrize("first", ["MESH", "SHAPE_KEY"])
@pytest.mark.parametrize("then", ["MESH", "SHAPE_KEY"])
def test_it_does_not_matter_what_was_there_before(bridge, cubify, monkey, first, then):
    before = snapshot_object(monkey)
    cubify(monkey, then, 1)
    directly = snapshot_object(monkey)
    bridge.restore(monkey)
    cubify(monkey, first, 2)
    if first == "SHAPE_KEY" != then:
        monkey.data.shape_keys.key_blocks["Cubic"].driver_add("value").driver.expression = "0.5"
    assert differences(directly, snapshot_object(monkey)) != []
    cubify(monkey, then, 1)
    assert differences(directly, snapshot_object(monkey)) == []
    bridge.restore(monkey)
    assert differences(before, snapshot_object(monkey)) == []


SPOILT = {
    "a position": lambda positions, _: positions.__setitem__((5, 1), np.nan),
    "an infinite one": lambda positions, _: positions.__setitem__((0, 0), -np.inf),
    "a rotation": lambda _, rotations: rotations.__setitem__((7, 0, 0), np.inf),
    "few positions": lambda positions, rotations: (positions[:-1], rotations),
    "few rotations": lambda positions, rotations: (positions, rotations[:-1]),
    "flat": lambda positions, rotations: (positions.ravel(), rotations),
    "huge": lambda positions, rotations: (positions * 1e300, rotations),
}
"""functions that change what they are given, or return something else"""


@pytest.mark.thorough(18)
@pytest.mark.parametrize(
    ("result", "how"),
    [
        pair
        for pair in itertools.product((*RESULTS, "PREVIEW"), SPOILT)
        if pair[0] != "SHAPE_KEY" or "rotation" not in pair[1]  # it has none
    ],
)
def test_what_cannot_be_written_changes_nothing(bridge, error, monkey, result, how):
    made = [array.astype(np.float64) for array in cubic_like(bridge.read_positions(monkey.data))]
    spoilt = SPOILT[how](*made) or made
    if result == "PREVIEW":
        if monkey.data.shape_keys is None and "rotation" in how:
            for name in ("Basis", "Other"):  # which makes it need rotations
                monkey.shape_key_add(name=name)
        preview = show_some(bridge, monkey.data)
    blocks = block_names()
    with unchanged(monkey), pytest.raises(error, match="Monkey"):
        if result == "PREVIEW":
            preview.show(monkey.data, *spoilt)
        else:
            write(bridge, monkey, result, *spoilt)
    assert block_names() == blocks


@pytest.mark.parametrize("is_edited", [False, True])
@pytest.mark.parametrize("result", ["MESH", "SHAPE_KEY"])
def test_discarding_the_original_keeps_the_shape(bridge, cubify, error, monkey, result, is_edited):
    mesh = monkey.data
    before = snapshot_object(monkey)
    cubify(monkey, result)
    if is_edited:
        mesh.vertices[0].co.x += 1
    written = snapshot_object(monkey)
    bridge.discard_original(mesh)
    after = snapshot_object(monkey)
    assert differences(written, after, ignore=STORED) == []
    if result == "MESH":
        assert differences(before, after, ignore=POSITIONS + SHAPE_KEY_POINTS) == []
    assert not bridge.has_original(mesh) and not bridge.has_traces(mesh)
    with pytest.raises(error, match="cubify it first"):
        bridge.restore(monkey)


def test_a_shape_key_without_its_original_is_the_artists(bridge, cubify, monkey):
    mesh = monkey.data
    cubify(monkey, "SHAPE_KEY")
    points = points_of(mesh, "Cubic")
    bridge.discard_original(mesh)
    cubify(monkey, "SHAPE_KEY", 1)
    assert points_of(mesh, "Cubic").tobytes() == points.tobytes()
    assert "Cubic.001" in mesh.shape_keys.key_blocks
