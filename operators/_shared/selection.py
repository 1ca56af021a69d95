# SPDX-License-Identifier: GPL-3.0-or-later
"""Which objects an operator works on."""

from ...cubic_craft_addon import job, live, mesh_bridge
from ...cubic_craft_addon.environment.modes import MESSAGE, is_mode_usable
from ...cubic_craft_addon.environment.requirements import check_known_requirements
from ...cubic_craft_addon.handles.owner import panel_object, posed_mesh
from ...cubic_craft_addon.object_properties import active_entry
from ...cubic_craft_addon.ui import seen
from ...solver import CubicCraftError


def selected_meshes(context):
    """Return the selected mesh objects, the active one first.

    If none is selected, those whose handles follow what is selected; if there are none either, the
    active one, or the one that it poses.
    """
    active = panel_object(context)
    selected = context.selected_objects
    objects = [obj for obj in selected if obj.type == "MESH"]
    if not objects:
        posed = (posed_mesh(context, obj) for obj in selected)
        objects = list(dict.fromkeys(obj for obj in posed if obj is not None))
    if not objects:
        return [active] if active is not None else []
    return sorted(objects, key=lambda obj: obj != active)


def refuse(operator_class, why):
    """Set what a button says while it is gray, and return false, as its `poll` does."""
    operator_class.poll_message_set(why)
    return False


def poll_idle(operator_class):
    """Return whether no Cubify runs, whose meshes must not be changed."""
    if job.current() is None:
        return True
    return refuse(operator_class, "Cubify is running; press Esc to cancel it")


def poll_panel_mesh(operator_class, context):
    """Return whether the panel shows a mesh, and set the message if not."""
    if not poll_idle(operator_class):
        return False
    if live.panel_mesh(context) is None:
        return refuse(operator_class, "Select a mesh object first")
    return True


def poll_mesh(operator_class, context, modes=("OBJECT",)):
    """Return whether there is a mesh that can be changed in one of these modes."""
    if not poll_idle(operator_class):
        return False
    if context.mode not in modes:
        is_edited = "OBJECT" not in modes
        return refuse(
            operator_class,
            "Select vertices in Edit Mode first" if is_edited else "Switch to Object Mode first",
        )
    obj = panel_object(context)
    if obj is None:
        return refuse(operator_class, "Make a mesh object active first")
    if not obj.is_editable:
        return refuse(operator_class, "The object is linked from another file; make it local")
    if mesh_bridge.is_linked(obj.data):
        return refuse(operator_class, "The mesh is linked from another file; make it local")
    return True


def poll_handle(operator_class, context):
    """Return whether there is an active handle."""
    if not poll_mesh(operator_class, context):
        return False
    if active_entry(panel_object(context), "handle") is None:
        return refuse(operator_class, "Add a handle first")
    return True


def selected_sources(context):
    """Return the selected objects with visible meshes, the active one first.

    If none is selected, those of `selected_meshes`, or the active one.
    """
    active = context.active_object
    objects = [obj for obj in context.selected_objects if obj.type in mesh_bridge.KINDS]
    objects = objects or selected_meshes(context)
    if not objects and active is not None and active.type in mesh_bridge.KINDS:
        return [active]
    return sorted(objects, key=lambda obj: obj != active)


def poll_sources(operator_class, context):
    """Return whether an object can be cubified, with or without its modifiers."""
    if not poll_work(operator_class, context) or not _poll_requirements(operator_class):
        return False
    if any(seen.can_be_seen(obj) for obj in selected_sources(context)):
        return True
    return poll_usable(operator_class, context)


def poll_meshes(operator_class, context):
    """Return whether there is a mesh to work on, and set the message if not."""
    if not poll_work(operator_class, context):
        return False
    if not selected_meshes(context):
        active = context.active_object
        why = mesh_bridge.why_no_mesh(active) if active is not None else ""
        return refuse(operator_class, why or "Select a mesh object first")
    return True


def poll_work(operator_class, context):
    """Return whether meshes can be changed now."""
    if not poll_idle(operator_class):
        return False
    if live.current() is not None:
        return refuse(operator_class, "Confirm or cancel Live first")
    if not is_mode_usable(context):
        return refuse(operator_class, MESSAGE)
    return True


def poll_object_mode(operator_class, context):
    """Return whether it is Object Mode, not one of those in which Cubify works too."""
    if context.mode == "OBJECT":
        return True
    return refuse(operator_class, MESSAGE)


def poll_usable(operator_class, context):
    """Return whether a mesh can be cubified, and set the message of the first one if not."""
    return (
        poll_meshes(operator_class, context)
        and _poll_requirements(operator_class)
        and poll_any_usable(operator_class, selected_meshes(context))
    )


def _poll_requirements(operator_class):
    try:
        check_known_requirements()
    except CubicCraftError as error:
        return refuse(operator_class, str(error))
    return True


def poll_any_usable(operator_class, objects, without=""):
    """Return whether one of the objects can be used, and set the message of the first if not.

    `without`: the message if there are none.
    """
    problems = [] if objects else [without]
    for obj in objects:
        try:
            mesh_bridge.check_usable(obj)
        except CubicCraftError as error:
            problems.append(str(error))
        else:
            return True
    return refuse(operator_class, problems[0])


def report_all(operator, done, problems):
    """Report what was done (a text, empty for nothing) and the problems, and return the status.

    ERROR means that nothing was done, WARNING that a part was.
    """
    if not done:
        operator.report({"ERROR"}, "; ".join(problems))
        return {"CANCELLED"}
    operator.report({"INFO"}, done)
    for problem in problems:  # last: Blender shows the last report
        operator.report({"WARNING"}, problem)
    return {"FINISHED"}
