# SPDX-License-Identifier: GPL-3.0-or-later
"""What the extension offers, called as its buttons do."""

import bpy
import guidrive as gui
import live_scene as scene
from mathutils import Matrix

from . import meshes
from .actions import action, active_mesh, call, is_cubifying, is_live, is_on, turns

FORMS = (
    *("CUBE", "CUBE", "CUBE", "BOX", "ROUNDED", "OCTAHEDRON", "TETRAHEDRON", "ICOSAHEDRON"),
    *("PRISM", "PYRAMID", "CYLINDER", "OBJECT", "DIRECTIONS", "FACES"),
)
invariants = None  # set by the walk


@action(7)
def cubify(rng):
    """Cubify; where it goes on beside Blender, wait for it or let something else come between."""
    done = call("cubic_craft.cubify", "INVOKE_DEFAULT") if is_on() else None
    if done is not None and rng.random() < 0.5:
        yield from gui.wait_until(lambda: not is_cubifying(), what="the end of Cubify")
    return done


@action(4)
def restore(_rng):
    """Restore, and see that the shape is what it has to be."""
    if not is_on():
        return None
    done = call("cubic_craft.restore", "INVOKE_DEFAULT")
    if done is None or not done.endswith("FINISHED"):
        return done
    now = meshes.read_all()
    restored = 0
    for uid, before in invariants.states.items():
        if before.has_traces and not now[uid].has_traces:
            if before.is_edited:  # what it then has to be, tests/blender knows
                invariants.accept(uid)
                continue
            assert now[uid].shape == before.original, f"Restore: {before.name} has another shape"
            restored += 1
    return f"{done}, {restored} meshes"
    yield


@action(2)
def restore_first(_rng):
    """Go back to what *From Here* has replaced."""
    if not is_on():
        return None
    return call("cubic_craft.restore_first", "INVOKE_DEFAULT")
    yield


@action(1)
def apply(_rng):
    return call("cubic_craft.apply", "INVOKE_DEFAULT") if is_on() else None
    yield


@action(1)
def auto_orient(_rng):
    return call("cubic_craft.auto_orient", "INVOKE_DEFAULT") if is_on() else None
    yield


@action(8)
def start_or_confirm_live(rng):
    if not is_on():
        return None
    done = call("cubic_craft.live", "INVOKE_DEFAULT")
    if done is not None:
        yield from turns(rng.choice([2, 10, 40]))
    return done


@action(1)
def cancel_live(_rng):
    return call("cubic_craft.live_cancel", "INVOKE_DEFAULT") if is_live() else None
    yield


@action(9)
def handles(rng):
    if not is_on():
        return None
    name = rng.choice(
        ["add", "remove", "move", "pin_selection", "follow", "follow", "reset_pose", "pose", "kind"]
    )
    if name in ("pose", "kind"):
        return _change_handle(name, rng)
    options = {"direction": rng.choice(["UP", "DOWN"])} if name == "move" else {}
    return call(f"cubic_craft.handle_{name}", "INVOKE_DEFAULT", **options)
    yield


def _change_handle(name, rng):
    """Move a handle by itself, or let it become cubic."""
    obj = active_mesh()
    if obj is None or not obj.cubic_craft.handles:
        return None
    handle = rng.choice(list(obj.cubic_craft.handles))
    if name == "kind":
        handle.is_cubic = not handle.is_cubic
    else:
        handle.pose = Matrix.Translation([rng.uniform(-0.3, 0.3) for _ in range(3)])
    bpy.ops.ed.undo_push(message="Change a handle")
    return f"{name} of {handle.group}"


@action(4)
def regions(rng):
    if not is_on():
        return None
    name = rng.choice(["add", "add", "remove", "from_selection", "change", "change", "change"])
    obj = active_mesh()
    if name != "change":
        if name == "from_selection" and obj and obj.mode == "OBJECT":
            vertices = obj.data.vertices
            vertices.foreach_set("select", [rng.random() < 0.3 for _ in vertices])
        return call(f"cubic_craft.region_{name}", "INVOKE_DEFAULT")
    if obj is None or not obj.cubic_craft.regions:
        return None
    region = rng.choice(list(obj.cubic_craft.regions))
    what, value = rng.choice(
        [
            ("form", rng.choice(FORMS)),
            ("cubeness", rng.choice([0.0, 0.2, 1.0, 5.0])),
            ("form_sides", rng.randrange(3, 10)),
            ("orientation", tuple(rng.uniform(-1, 1) for _ in range(3))),
            ("form_object", rng.choice(list(bpy.data.objects))),
            ("group", rng.choice(["Group", "Handle", "missing"])),
        ]
    )
    setattr(region, what, value)
    bpy.ops.ed.undo_push(message="Change a region")
    return f"{what} = {value!r}"
    yield


@action(1)
def directions_from_selection(_rng):
    return call("cubic_craft.form_from_selection", "INVOKE_DEFAULT") if is_on() else None
    yield


@action(7)
def change_setting(rng):
    """Change a setting where the panel would: on the object, or in Live on the session."""
    obj = active_mesh()
    if not is_on() or obj is None:
        return None
    target = scene.live().shared_properties(obj)
    name, value = rng.choice(
        [
            ("cubeness", rng.choice([0.0, 0.1, 0.5, 1.0, 5.0])),
            ("cubeness", rng.random()),
            ("orientation", tuple(rng.uniform(-1, 1) for _ in range(3))),
            ("space", rng.choice(["OBJECT", "OBJECT", "WORLD", "WORLD", "FRAME"])),
            ("map_group", rng.choice(["", "", "Handle", "Group", "missing"])),
            ("map_invert", rng.random() < 0.5),
            ("use_handles", rng.random() < 0.5),
            ("use_regions", rng.random() < 0.7),
            ("form", rng.choice(FORMS)),
            ("form", rng.choice(FORMS)),
            ("form_sides", rng.randrange(3, 10)),
            ("form_weights", tuple(rng.choice([0.0, 1.0, 2.0]) for _ in range(3))),
            ("form_object", rng.choice(list(bpy.data.objects))),
            ("capture_object", rng.choice(list(bpy.data.objects))),
            ("capture_strength", rng.choice([0.0, 0.0, 0.4])),
            ("result", rng.choice(["MESH", "MESH", "SHAPE_KEY", "NEW_OBJECT"])),
            ("solidity", rng.choice([0.0, 0.1, 1.0, 10.0])),
            ("keep_pose", rng.random() < 0.5),
            ("detail", rng.choice([0.0, 0.05, 0.3, 1.0])),
            ("keep_apart", rng.random() < 0.5),
            ("together", rng.choice(["OFF", "PARTS", "SELECTION"])),
            ("refine", rng.choice(["AUTO", "OFF"])),
            ("rotation", rng.choice(["KEEP", "FREE"])),
            ("keep_symmetric", rng.random() < 0.5),
            ("symmetry", tuple(rng.random() < 0.4 for _ in range(3))),
            ("floor", rng.choice(["AUTO", "ON", "OFF"])),
            ("hold_rest", rng.random() < 0.5),
            ("start", rng.choice(["HERE", "ORIGINAL", "EDITS"])),
            ("with_modifiers", rng.random() < 0.3),
            ("preset", rng.choice(["Soft", "Cubic", "As_in_the_Paper"])),
            ("device", rng.choice(["AUTO", "NUMPY"])),
            ("max_iterations", rng.choice([1, 5, 40])),
            ("tolerance", rng.choice([1e-5, 1e-3, 1.0])),
            ("frame", rng.choice(list(bpy.data.objects))),
        ]
    )
    if not hasattr(target, name):  # Live has not all
        return None
    if name in ("frame", "form_object", "capture_object") and is_live():
        value = value.name
    setattr(target, name, value)
    if not is_live():
        bpy.ops.ed.undo_push(message="Change a setting")
    return f"{name} = {value!r}"
    yield


@action(1)
def key_setting(_rng):
    """Animate a setting."""
    obj = active_mesh()
    if not is_on() or obj is None:
        return None
    obj.keyframe_insert("cubic_craft.cubeness")
    bpy.ops.ed.undo_push(message="Insert a key")
    return obj.name
    yield


@action(1)
def change_preference(rng):
    if not is_on():
        return None
    if rng.random() < 0.5:
        manager = bpy.context.window_manager
        name = rng.choice(("cubic_craft_overlay", "cubic_craft_angles"))
        setattr(manager, name, not getattr(manager, name))
        return name
    preferences = bpy.context.preferences.addons[scene.EXTENSION].preferences
    preferences.tab = "Other"
    yield from turns(3)
    preferences.tab = "Cubic Craft"
    yield from gui.wait_redraw()
    return "tab"


@action(1.5)
def switch_off(_rng):
    if not is_on():
        return None
    bpy.ops.preferences.addon_disable(module=scene.EXTENSION)
    yield from turns(3)
    return "off"


@action(30)
def switch_on(rng):
    if is_on() or rng.random() < 0.5:
        return None
    bpy.ops.preferences.addon_enable(module=scene.EXTENSION)
    yield from turns(5)
    return "on"
