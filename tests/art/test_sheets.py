# SPDX-License-Identifier: GPL-3.0-or-later
"""Open sheets, fingers side by side, inverted and broken meshes: what is near is not always one."""

import art_sheets
import art_solids
import measures
import numpy as np
import pytest
from art_cases import cubified, outcome_of
from mathutils import Matrix
from scene import given

ABOVE, BELOW = 1, 2


@pytest.mark.thorough(2)
@pytest.mark.parametrize("cubeness", [0.4, 0.2, 1.0])
def test_blocks_stay_at_their_side_of_a_sheet(cubeness):
    outcome = outcome_of("cubes_at_sheet", cubeness)
    sheet = outcome.after.of(0)
    # where a block's rounded edge leaves the sheet, nothing holds them apart
    assert measures.share_behind(outcome.after.of(ABOVE)[0], *sheet) <= 0.0125
    assert measures.share_behind(outcome.after.of(BELOW)[0], *sheet) >= 0.9875


@pytest.mark.thorough(2)
@pytest.mark.parametrize("cubeness", [0.4, 0.2, 1.0])
def test_a_cape_stays_before_the_wall(cubeness):
    outcome = outcome_of("cape", cubeness)
    assert measures.share_inside(outcome.after.of(1)[0], *outcome.after.of(0)) <= 0.005


@pytest.mark.parametrize("name", ["cape", "cubes_at_sheet", "two_sheets", "waves"])
def test_no_sheet_comes_to_cross_another(name):
    assert outcome_of(name).new_crossings() <= len(outcome_of(name).F) / 2000


def test_a_lone_sheet_has_no_other_side():
    results = [cubified(art_sheets.wavy_plane(), solidity=solidity).U for solidity in (0.0, 1.0)]
    assert np.array_equal(*results)


@pytest.mark.thorough(1)
@pytest.mark.parametrize("is_inverted", [False, True])
def test_a_finger_that_is_pulled_away_leaves_the_others_alone(is_inverted):
    pulled = Matrix.Translation((-0.3, -0.1, 0.4))
    here, there = (hand_with_finger_at(place, is_inverted) for place in (Matrix(), pulled))
    moved = np.linalg.norm(there - here, axis=1) / measures.size_of(here)
    assert moved[finger_vertices(0)].min() >= 0.2
    assert moved[finger_vertices(1, 2, 3)].max() <= 0.0125, "it no longer keeps the next one away"


@pytest.mark.parametrize("name", ["hand", "hand_inverted"])
def test_fingers_side_by_side_stay_so(name):
    outcome = outcome_of(name)
    assert outcome.new_crossings() <= len(outcome.F) / 2000
    for one, other in zip(middles(outcome.U), middles(outcome.V), strict=True):
        assert np.linalg.norm(one - other) <= 0.03 * measures.size_of(outcome.V)


def test_an_inverted_mesh_becomes_what_it_is_the_right_way_round():
    outcome, inverted = outcome_of("hand"), outcome_of("hand_inverted")
    assert inverted.angle()[1] == pytest.approx(outcome.angle()[1], rel=0.1)
    assert inverted.volume_ratio() == pytest.approx(outcome.volume_ratio(), rel=0.1)


@pytest.mark.parametrize("name", ["mixed", "fin", "pinched", "bowl", "pipe", "waves", "cup"])
def test_whatever_the_mesh_it_becomes_cubic_and_stays_in_its_place(name):
    outcome = outcome_of(name)
    V, U = outcome.V, outcome.U
    assert outcome.angle_ratio() <= 0.9
    # an ellipsoid aslant leans as it becomes a box, which counts as a turn
    assert measures.turn(V, U, outcome.F) <= (2 if name == "fin" else 1)
    assert np.all(np.ptp(U, axis=0) <= 1.15 * np.ptp(V, axis=0).max())


def hand_with_finger_at(place, is_inverted):
    """Return the positions after Cubify with a held palm and the first finger moved."""
    objects = art_solids.hand(is_inverted)
    return cubified(objects, handles=[given("Palm"), given("Finger 0", place)]).U


def middles(U):
    """Return the middle of each finger, at positions U (n,3)."""
    return [U[finger_vertices(number)].mean(axis=0) for number in range(4)]


def finger_vertices(*numbers):
    """Return the vertices of some fingers of the hand."""
    (obj,) = art_solids.hand()
    groups = [obj.vertex_groups[f"Finger {number}"].index for number in numbers]
    members = [
        vertex.index
        for vertex in obj.data.vertices
        if any(element.group in groups for element in vertex.groups)
    ]
    return np.array(members)
