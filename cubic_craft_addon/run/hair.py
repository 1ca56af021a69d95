# SPDX-License-Identifier: GPL-3.0-or-later
"""Hair that grows on a mesh: an object of curves that names the mesh as its surface.

Its curves have positions of their own. Blender moves them with the surface only where a modifier
deforms them, and that measures from the shape below shape keys: a result in the mesh itself leaves
all hair behind. Blender has an operator that puts it back on the surface.
"""

import bpy


def hair_left_behind(obj: bpy.types.Object, result: str) -> list[str]:
    """Return a text for the hair that does not follow a result, as a list of one or none.

    `obj`: the mesh object. `result`: {"MESH", "SHAPE_KEY", "NEW_OBJECT"}, where the result is
    written to.
    """
    if result == "NEW_OBJECT":
        return []
    names = [
        f'"{hair.name}"'
        for hair in bpy.data.objects
        if isinstance(hair.data, bpy.types.Curves)
        and hair.data.surface == obj
        and not (result == "SHAPE_KEY" and any(m.type == "NODES" for m in hair.modifiers))
    ]
    if not names:
        return []
    others = f" and {len(names) - 1} more" if len(names) > 1 else ""
    return [
        f'Hair {names[0]}{others} does not follow "{obj.name}": in its Sculpt Mode, choose Curves '
        "> Snap to Deformed Surface"
    ]
