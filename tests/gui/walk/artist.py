# SPDX-License-Identifier: GPL-3.0-or-later
"""What an artist does with meshes and objects."""

import bpy
import guidrive as gui

from .actions import MOST_OBJECTS, MOST_VERTICES, action, active, active_mesh, call, meshes_in_view

_PRIMITIVES = (
    ("mesh.primitive_monkey_add", {}),
    ("mesh.primitive_uv_sphere_add", {"segments": 12, "ring_count": 8}),
    ("mesh.primitive_ico_sphere_add", {"subdivisions": 3}),
    ("mesh.primitive_torus_add", {"major_segments": 16, "minor_segments": 8}),
    ("mesh.primitive_cylinder_add", {"vertices": 12, "end_fill_type": "NGON"}),
    ("mesh.primitive_grid_add", {"x_subdivisions": 6, "y_subdivisions": 6}),
)

# Our attributes are called so, and vertex groups may be, too.
_NAMES_OF_OURS = ("cubic_craft_original", "cubic_craft_rotation", "cubic_craft_live")


def _small(rng):
    return tuple(round(rng.uniform(-0.4, 0.4), 3) for _ in range(3))


@action(3, reshapes=True)
def add_mesh(rng):
    if bpy.context.mode == "OBJECT" and len(bpy.data.objects) >= MOST_OBJECTS:
        return None
    if bpy.context.mode == "EDIT_MESH" and len(active_mesh().data.vertices) > MOST_VERTICES // 2:
        return None
    if bpy.context.mode == "EDIT_MESH" and bpy.context.object.hide_get():
        return None  # Blender's own torus fails there
    name, options = rng.choice(_PRIMITIVES)
    location = tuple(rng.uniform(-2, 2) for _ in range(3))
    return call(name, location=location, **options)


@action(4)
def select_one(rng):
    objects = list(bpy.context.view_layer.objects)
    if bpy.context.mode != "OBJECT" or not objects:
        return None
    chosen = rng.choice(meshes_in_view() or objects)
    for obj in objects:
        obj.select_set(obj == chosen)
    bpy.context.view_layer.objects.active = chosen
    bpy.ops.ed.undo_push(message="Select")
    return chosen.name


@action(1)
def select_all(rng):
    name = "mesh.select_all" if bpy.context.mode == "EDIT_MESH" else "object.select_all"
    return call(name, action=rng.choice(["SELECT", "DESELECT", "INVERT"]))


@action(2, reshapes=True)
def duplicate(rng):
    if len(bpy.data.objects) >= MOST_OBJECTS:
        return None
    return call("object.duplicate", linked=rng.random() < 0.4)


@action(1.5)
def delete_object(_rng):
    return call("object.delete") if len(bpy.data.objects) > 2 else None


@action(5)
def change_mode(rng):
    if active_mesh() is None:
        return None
    mode = rng.choice(["OBJECT", "OBJECT", "EDIT", "EDIT", "WEIGHT_PAINT", "SCULPT"])
    return call("object.mode_set", mode=mode)


@action(7, reshapes=True)
def edit_mesh(rng):
    if bpy.context.mode != "EDIT_MESH":
        return None
    kind = rng.choice(["select", "select", "move", "move", "scale", "delete", "cut", "tidy"])
    if kind == "select":
        return call("mesh.select_random", ratio=rng.choice([0.05, 0.2]), seed=rng.randrange(99))
    if kind == "move":
        return call("transform.translate", value=_small(rng))
    if kind == "scale":
        return call("transform.resize", value=(rng.uniform(0.7, 1.3),) * 3)
    if kind == "delete":
        return call("mesh.delete", type=rng.choice(["VERT", "FACE", "ONLY_FACE"]))
    if kind == "cut":
        is_small = len(active_mesh().data.vertices) < MOST_VERTICES // 4
        return call("mesh.subdivide") if is_small else None
    return call(rng.choice(["mesh.remove_doubles", "mesh.flip_normals", "mesh.sort_elements"]))


def _transforming_crashes():
    """Return whether Blender 4.3 crashes on it: without a brush, also without the extension."""
    return bpy.context.mode == "SCULPT"


@action(2, reshapes=True)
def transform(rng):
    """Move, scale or mirror what is selected: in Edit Mode, vertices."""
    if _transforming_crashes():
        return None
    kind = rng.choice(["translate", "rotate", "resize"])
    if kind == "translate":
        return call("transform.translate", value=_small(rng))
    if kind == "rotate":
        return call("transform.rotate", value=rng.uniform(-1, 1), orient_axis=rng.choice("XYZ"))
    scale = [rng.choice([0.8, 1.0, 1.3]) for _ in range(3)]
    scale[0] *= rng.choice([1, 1, -1])
    return call("transform.resize", value=scale)


@action(2, reshapes=True)
def apply_transform(rng):
    location, rotation = rng.random() < 0.3, rng.random() < 0.5
    return call("object.transform_apply", location=location, scale=True, rotation=rotation)


@action(1, reshapes=True)
def set_origin(rng):
    kinds = ["GEOMETRY_ORIGIN", "ORIGIN_GEOMETRY", "ORIGIN_CURSOR", "ORIGIN_CENTER_OF_MASS"]
    return call("object.origin_set", type=rng.choice([*kinds, "ORIGIN_CENTER_OF_VOLUME"]))


@action(1, reshapes=True)
def mirror(rng):
    if _transforming_crashes():
        return None
    axis = [rng.random() < 0.5 for _ in range(3)]
    return call("transform.mirror", constraint_axis=axis)


@action(1, reshapes=True)
def join(_rng):
    selected = [o for o in bpy.context.selected_objects if o.type == "MESH"]
    if len(selected) < 2 or sum(len(o.data.vertices) for o in selected) > MOST_VERTICES:
        return None
    return call("object.join")


@action(4, reshapes=True)
def shape_keys(rng):
    obj = active_mesh()
    if obj is None:
        return None
    keys = obj.data.shape_keys
    kind = rng.choice(["add", "add", "mix", "remove", "clear", "dial", "pick", "rename", "move"])
    if kind in ("add", "mix"):
        return call("object.shape_key_add", from_mix=kind == "mix")
    if keys is None:
        return None
    if kind == "remove":
        return call("object.shape_key_remove")
    if kind == "clear":
        return call("object.shape_key_remove", all=True)
    if kind == "move":
        return call("object.shape_key_move", type=rng.choice(["UP", "DOWN", "TOP", "BOTTOM"]))
    number = rng.randrange(len(keys.key_blocks))
    if kind == "pick":
        obj.active_shape_key_index = number
    elif kind == "dial":
        keys.key_blocks[number].value = rng.random()
    else:
        keys.key_blocks[number].name = rng.choice(["Cubic", "Basis", "Smile", "é" * 30])
    bpy.ops.ed.undo_push(message="Shape key")
    return f"{kind} {number}"


@action(3)
def vertex_groups(rng):
    obj = active_mesh()
    if obj is None:
        return None
    kind = rng.choice(["add", "fill", "fill", "remove", "rename"])
    if kind == "add":
        return call("object.vertex_group_add")
    if not obj.vertex_groups:
        return None
    if kind == "remove":
        return call("object.vertex_group_remove")
    group = obj.vertex_groups[rng.randrange(len(obj.vertex_groups))]
    if kind == "rename":
        group.name = rng.choice(["Handle", "Ear", *_NAMES_OF_OURS])
    elif obj.mode == "EDIT":
        return call("object.vertex_group_assign")
    else:
        count = len(obj.data.vertices)
        chosen = rng.sample(range(count), count // 4)
        group.add(chosen, rng.choice([0.3, 1.0]), "REPLACE")
        obj.data.update()
    bpy.ops.ed.undo_push(message="Vertex group")
    return f"{kind} {group.name}"


@action(1, reshapes=True)
def modifiers(rng):
    obj = active_mesh()
    if obj is None:
        return None
    if obj.modifiers and rng.random() < 0.6:
        name = obj.modifiers[0].name
        is_small = len(obj.data.vertices) < MOST_VERTICES // 4
        if is_small and rng.random() < 0.4:
            return call("object.modifier_apply", modifier=name)
        return call("object.modifier_remove", modifier=name)
    return call("object.modifier_add", type=rng.choice(["SUBSURF", "MIRROR", "TRIANGULATE"]))


@action(1)
def single_user(_rng):
    return call("object.make_single_user", object=True, obdata=True)


@action(1)
def rename(rng):
    obj = active()
    if obj is None:
        return None
    obj.name = rng.choice(["Suzanne", "Other", "Ünïcödé", "x" * 70])
    if obj.data is not None:
        obj.data.name = obj.name
    bpy.ops.ed.undo_push(message="Rename")
    return obj.name


@action(5)
def move_target(rng):
    """Move what a handle follows, or a frame."""
    others = [o for o in bpy.data.objects if o.type == "EMPTY"]
    if not others:
        return None
    target = rng.choice(others)
    target.location[rng.randrange(3)] += rng.uniform(-0.3, 0.3)
    bpy.ops.ed.undo_push(message="Move")
    return target.name


@action(2)
def change_frame(rng):
    number = rng.randrange(1, 20)
    bpy.context.scene.frame_set(number)
    if rng.random() < 0.3:
        bpy.ops.ed.undo_push(message="Change frame")
    return str(number)


@action(1)
def add_empty(_rng):
    if len(bpy.data.objects) >= MOST_OBJECTS:
        return None
    return call("object.empty_add", location=(0.5, -1, 0.5))


@action(1)
def hide_or_show(rng):
    if rng.random() < 0.6 or len(meshes_in_view()) < 2:
        return call("object.hide_view_clear")
    return call("object.hide_view_set")


@action(2)
def rest(rng):
    """Do nothing for a while: Live gets to its end, or on its way."""
    count = rng.choice([5, 20, 60])
    for _ in range(count):
        yield
    yield from gui.wait_redraw()
    return f"{count} turns"
