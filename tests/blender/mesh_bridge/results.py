# SPDX-License-Identifier: GPL-3.0-or-later
"""The three kinds of a result, given to an object as Cubify does."""

RESULTS = ("MESH", "SHAPE_KEY", "NEW_OBJECT")
COPIED = ("*rna/name", "*rna/data", "*rna/shape_keys", "*rna/active_shape_key", "*rna/user")
COPIED += ("*rna/animation_data",)
"""what of a new object is another data-block by nature"""


def write(bridge, obj, result, positions, rotations, start="HERE"):
    """Write a result; return the object that has it."""
    if result == "MESH":
        bridge.write_mesh(obj.data, positions, rotations, start=start)
    elif result == "SHAPE_KEY":
        bridge.write_shape_key(obj, positions, start=start)
    else:
        return bridge.write_new_object(obj, positions, rotations, start=start)
    return obj
