# SPDX-License-Identifier: GPL-3.0-or-later
"""What the extension offers, called as its buttons do."""

import importlib
import pathlib
import sys

import bpy
import guidrive as gui
import live_scene as scene
from mathutils import Matrix

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "hostile"))
import worth_trying

from . import meshes
from .actions import action, active_mesh, call, is_cubifying, is_live, is_on, turns

method = importlib.import_module(f"{scene.EXTENSION}.solver.method")
OPTIONS = {name: worth_trying.values(each) for name, each in method.SETTINGS.items()} | {
    "map_group": ["", "", "Handle", "Group", "missing"],
    "result": ["MESH", "MESH", "SHAPE_KEY", "NEW_OBJECT"],
    "start": ["HERE", "ORIGINAL", "EDITS"],
    "with_modifiers": [False, False, True],
    "preset": ["Soft", "Cubic", "As_in_the_Paper"],
    "device": ["AUTO", "NUMPY"],
    "max_iterations": [1, 5, 40],
    **dict.fromkeys(("frame", "form_object")),  # any object
}
"""values of the settings"""
OF_REGION = ("form", "cubeness", "form_sides", "form_weights", "orientation", "form_object")
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


@action(2)
def restore_first(_rng):
    """Go back to what *From Here* has replaced."""
    if not is_on():
        return None
    return call("cubic_craft.restore_first", "INVOKE_DEFAULT")


@action(1)
def apply(_rng):
    return call("cubic_craft.apply", "INVOKE_DEFAULT") if is_on() else None


@action(1)
def auto_orient(_rng):
    return call("cubic_craft.auto_orient", "INVOKE_DEFAULT") if is_on() else None


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
    what = rng.choice([*OF_REGION, "group"])
    values = ["Group", "Handle", "missing"] if what == "group" else OPTIONS[what]
    value = rng.choice(values or list(bpy.data.objects))
    setattr(region, what, value)
    bpy.ops.ed.undo_push(message="Change a region")
    return f"{what} = {value!r}"


@action(1)
def directions_from_selection(_rng):
    return call("cubic_craft.form_from_selection", "INVOKE_DEFAULT") if is_on() else None


@action(7)
def change_setting(rng):
    """Change a setting where the panel would: on the object, or in Live on the session."""
    obj = active_mesh()
    if not is_on() or obj is None:
        return None
    target = scene.live().shared_properties(obj)
    name = rng.choice([*OPTIONS, "cubeness", "form"])
    value = rng.choice(OPTIONS.get(name) or list(bpy.data.objects))
    if not hasattr(target, name):  # Live has not all
        return None
    if name in ("frame", "form_object") and is_live():
        value = value.name
    setattr(target, name, value)
    if not is_live():
        bpy.ops.ed.undo_push(message="Change a setting")
    return f"{name} = {value!r}"


@action(1)
def key_setting(_rng):
    """Animate a setting."""
    obj = active_mesh()
    if not is_on() or obj is None:
        return None
    obj.keyframe_insert("cubic_craft.cubeness")
    bpy.ops.ed.undo_push(message="Insert a key")
    return obj.name


@action(1)
def change_preference(rng):
    if not is_on():
        return None
    if rng.random() < 0.5:
        manager = bpy.context.window_manager
        name = "cubic_craft_overlay"
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
