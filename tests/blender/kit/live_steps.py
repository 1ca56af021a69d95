# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of Live do with its session, and what they ask of it in the end."""

import importlib
import time

import bpy
import numpy as np
import scene

STEPS = 4000


def add_monkey(name="Suzanne", **where):
    """Add a monkey that is solved as quickly as `scene.cubify` does it."""
    obj = scene.add_monkey(name, **where)
    scene.change_settings(obj, **scene.QUICK)
    return obj


def bits(obj):
    values = np.empty(3 * len(obj.data.vertices), np.float32)
    obj.data.vertices.foreach_get("co", values)
    return values.tobytes()


def follower_of(obj):
    return bpy.data.objects[f"{obj.name} Cubic"]


def tick_to_rest(session):
    bpy.context.view_layer.update()
    for _ in range(STEPS):
        session.tick(bpy.context)
        bpy.context.view_layer.update()
        if session.is_ended or session._timer is None:
            return session
        if not session._runs.is_working:
            time.sleep(0.005)  # for a pause, after which an original is solved exactly
    raise AssertionError("Live does not come to rest")


def tick_to_sight(session):
    """Tick until all runs are seen, which takes more ticks the slower the machine is."""
    for _ in range(STEPS):
        session.tick(bpy.context)
        if all(mesh.is_seen for mesh in session.meshes):
            return session
    raise AssertionError("Live shows nothing")


def wake_to_rest(session):
    """Let it see what has been done to the objects."""
    session.wake()
    tick_to_rest(session)


def check_same_as_cubify(obj):
    """Check that Cubify, with the settings that Live has left, gives the shape that is there."""
    shape = bits(obj)
    scene.select(obj)
    bpy.ops.cubic_craft.cubify()
    assert bits(obj) == shape


def confirm(live, session):
    session.on(live.Event.CONFIRM)
    tick_to_rest(session)
    assert session.is_ended and not session.error and not session.written.problems
    return session


def check_gone(live):
    assert live.current() is None
    handlers = importlib.import_module(f"{live.__name__}.handlers")
    assert not handlers.is_installed()
    for name, handler in handlers._HANDLERS:
        assert handler not in getattr(bpy.app.handlers, name)
    session = live._session
    assert session._timer is None
    assert not session.tasks and not session._plan.groups and not session._plan.overrides.pointers
    assert not session._runs._runs
    for mesh in session.meshes:
        assert mesh._preview is None and mesh.member is None and not mesh.run.is_started
    for mesh in bpy.data.meshes:
        assert not [a.name for a in mesh.attributes if a.name.startswith("cubic_craft_live")]
