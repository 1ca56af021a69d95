# SPDX-License-Identifier: GPL-3.0-or-later
"""How long the ticks of Live take; run by scripts/benchmark_live.py.

For a coarse monkey and each mesh in /share it drags the slider for ten seconds. It writes what each
tick took, and how long each change took in ticks to be seen, to /share/ticks.json. What Blender
itself draws is not part of the ticks.
"""

import json
import os
import pathlib
import time

import bpy
import guidrive as gui
import live_scene as scene

SECONDS = 10.0
FOLDER = pathlib.Path(os.environ.get("BENCH_FOLDER", "/share"))


class Stopwatch:
    """Times every tick of a session, and the ticks from a change until an object shows it."""

    def __init__(self, session, name):
        self.ticks, self.delays = [], []
        self._name, self._since = name, None
        self._tick, session.tick = session.tick, self.tick

    def changed(self):
        self._since = self._since or 0.0

    def tick(self, context):
        before, begin = scene.positions(self._name), time.perf_counter()
        self._tick(context)
        self.ticks.append(time.perf_counter() - begin)
        if self._since is not None:
            self._since += self.ticks[-1]
            if scene.positions(self._name) != before:
                self.delays.append(self._since)
                self._since = None


def load(path, cuts):
    """Make the scene hold nothing but the mesh of a file, or a monkey subdivided so many times.

    The edges of a file's mesh are then cut so many times.
    """
    if isinstance(path, int):
        scene.add_monkey(path)
        return bpy.context.object
    with gui.in_region():
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        read = bpy.ops.wm.ply_import if path.suffix == ".ply" else bpy.ops.wm.obj_import
        read(filepath=str(path))
        obj = bpy.context.selected_objects[0]
        bpy.context.view_layer.objects.active = obj
        size = max(obj.dimensions)
        obj.scale = (3 / size,) * 3
        if cuts:
            obj.modifiers.new("Cuts", "SUBSURF").subdivision_type = "SIMPLE"
            obj.modifiers["Cuts"].levels = cuts
            bpy.ops.object.modifier_apply(modifier="Cuts")
        bpy.ops.ed.undo_push(message="Load")
    return obj


def measure(path, cuts=0):
    obj = load(path, cuts)
    name, vertices = obj.name, len(obj.data.vertices)
    yield from gui.wait_redraw()
    yield from gui.open_sidebar("Cubic Craft")
    yield from scene.start_live()
    yield from scene.wait_idle()
    slider = yield from gui.find_button("cubic_craft_live.cubeness")
    watch = Stopwatch(scene.live().current(), name)
    properties = bpy.context.window_manager.cubic_craft_live
    last, begin = properties.cubeness, time.monotonic()
    ends = 0.2, 0.8
    while time.monotonic() - begin < SECONDS:
        drag = gui.drag(slider.at(ends[0]), slider.at(ends[1]), steps=24)
        ends = ends[::-1]
        for turn in drag:
            if properties.cubeness != last:
                last = properties.cubeness
                watch.changed()
            yield turn
    seconds = time.monotonic() - begin
    yield from gui.screenshot(f"{name}.png")
    yield from scene.press("ESC")
    yield from gui.wait_until(scene.is_over, what="the end")
    return {
        "mesh": name,
        "vertices": vertices,
        "ticks": watch.ticks,
        "seconds": seconds,
        "delays": watch.delays,
    }


def test():
    gui.simplify_viewport()
    rows = []
    paths = sorted([*FOLDER.glob("*.obj"), *FOLDER.glob("*.ply")])
    for path in (1, *(paths or (2, 3))):  # the first is coarse, and is refined
        rows.append((yield from measure(path)))
    if paths:
        rows.append((yield from measure(paths[-1], cuts=1)))  # a large one
    (FOLDER / "ticks.json").write_text(json.dumps(rows))


gui.run(test)
