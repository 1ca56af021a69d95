# SPDX-License-Identifier: GPL-3.0-or-later
"""What we keep on a mesh: told apart from the artist's own, found and removed also when stale."""

import json

import bpy
import pytest
from rich_mesh import cubic_like, position_of
from snapshot import differences, snapshot_object, unchanged

NOTE = "cubic_craft_note"
KEY = {"name": "Wide", "fingerprint": "0", "base": "0", "made_basis": False}


@pytest.mark.parametrize("result", ["MESH", "SHAPE_KEY"])
def test_property_of_the_artist_called_cubic_craft(bridge, cubify, monkey, result):
    monkey.data["cubic_craft"] = "rounded by hand"
    with unchanged(monkey):
        for seed in (1, 2):
            cubify(monkey, result, seed)
            assert monkey.data["cubic_craft"] == "rounded by hand"
        bridge.restore(monkey)


@pytest.mark.parametrize(
    "value",
    [
        3,
        "text",
        "[" * 100_000,
        "[]",
        '{"version": 1}',
        {"mesh": 1},
        json.dumps({"version": 0, "key": KEY}),
        json.dumps({"version": 1, "key": KEY, "mine": 1}),
        json.dumps({"version": 1, "key": KEY | {"base": 1}}),
        json.dumps({"version": 1, "key": KEY | {"made_basis": "a"}}),
        json.dumps({"version": 1, "mesh": {"fingerprint": "0"}}),
        json.dumps({"version": 1, "mesh": {"fingerprint": "0", "keys": [1]}}),
    ],
)
def test_property_of_others_under_our_name_is_never_touched(bridge, error, keyed_monkey, value):
    mesh = keyed_monkey.data
    mesh[NOTE] = value
    before = snapshot_object(keyed_monkey)
    objects = len(bpy.data.objects)
    positions, rotations = cubic_like(bridge.original_positions(mesh))
    assert not bridge.has_original(mesh) and not bridge.has_traces(mesh)
    bridge.discard_original(mesh)
    for call in (
        lambda: bridge.check_usable(keyed_monkey),
        lambda: bridge.write_mesh(mesh, positions, rotations),
        lambda: bridge.write_shape_key(keyed_monkey, positions),
        lambda: bridge.write_new_object(keyed_monkey, positions, rotations),
        lambda: bridge.Preview(mesh),
    ):
        with pytest.raises(error, match=f'"Monkey" has a custom property "{NOTE}".*rename'):
            call()
    assert differences(before, snapshot_object(keyed_monkey)) == []
    assert len(bpy.data.objects) == objects
    with pytest.raises(error, match="cubify it first"):
        bridge.restore(keyed_monkey)


def test_valid_note_is_not_in_the_way(bridge, cubify, keyed_monkey):
    """The opposite of the above: none of those is refused for how it is made here."""
    keyed_monkey.data[NOTE] = json.dumps({"version": 1, "key": KEY})
    assert bridge.has_traces(keyed_monkey.data)
    bridge.check_usable(keyed_monkey)
    cubify(keyed_monkey)


LOST = {
    "original": ("_original",),
    "attributes": ("_original", "_rotation"),
    "marks": ("_original.mark", "_original.written"),
    "key": (),
}
"""what of ours is lost, as attributes"""


@pytest.mark.parametrize("what", LOST)
def test_stale(bridge, cubify, error, plain_monkey, what):
    mesh = plain_monkey.data
    cubify(plain_monkey, "SHAPE_KEY" if what == "key" else "MESH")
    for name in LOST[what]:
        mesh.attributes.remove(mesh.attributes[f"cubic_craft{name}"])
    if what == "marks":
        mesh.vertices[0].co.x += 1
    elif what == "key":
        plain_monkey.shape_key_remove(mesh.shape_keys.key_blocks["Cubic"])
    with unchanged(plain_monkey):
        shape = position_of(mesh).tobytes()
        assert bridge.has_traces(mesh) and not bridge.has_original(mesh)
        assert bridge.original_positions(mesh).tobytes() == shape
        with pytest.raises(
            error, match=r'"Suzanne" has been edited since .* now the original: Apply'
        ):
            bridge.restore(plain_monkey)
    bridge.discard_original(mesh)
    assert not bridge.has_traces(mesh)
    assert NOTE not in mesh
    assert not [a.name for a in mesh.attributes if a.name.startswith("cubic_craft")]
    assert position_of(mesh).tobytes() == shape
