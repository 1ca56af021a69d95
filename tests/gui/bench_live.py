# SPDX-License-Identifier: GPL-3.0-or-later
"""How long the ticks of Live take while its slider is dragged; run by scripts/benchmark_live.py.

For a coarse monkey and each mesh in /share it drags for ten seconds. To /share/ticks.json it writes
what each tick took, how long each change took to be seen, and how many iterations were done.
Blender's own drawing is not part of the ticks.
"""

import importlib
import json
import os
import pathlib
import sys
import time

import bpy
import guidrive as gui
import live_scene as scene

SECONDS = 10.0
FOLDER = pathlib.Path(os.environ.get("BENCH_FOLDER", "/share"))


class Stopwatch:
    """Times every tick of a session, and what passes from a change until it is seen.

    A delay is counted twice: with what Blender does between the ticks (drawing in software, here),
    and as the sum of the ticks alone.
    """

    def __init__(self, session):
        self.ticks, self.delays, self.delays_of_ticks = [], [], []
        self._session, self._changed_at, self._ticks_since = session, None, 0.0
        self._tick, session.tick = session.tick, self.tick
        self._show, session._show = session._show, self.show
        self._is_seen = False

    def changed(self):
        if self._changed_at is None:
            self._changed_at, self._ticks_since = time.perf_counter(), 0.0

    def show(self, objects):
        before = scene.positions(next(iter(objects.values())).name)
        self._show(objects)
        self._is_seen = scene.positions(next(iter(objects.values())).name) != before

    def tick(self, context):
        begin = time.perf_counter()
        self._is_seen = False
        self._tick(context)
        end = time.perf_counter()
        self.ticks.append(end - begin)
        self._ticks_since += end - begin
        if self._is_seen and self._changed_at is not None:
            self.delays.append(end - self._changed_at)
            self.delays_of_ticks.append(self._ticks_since)
            self._changed_at = None


class Counter:
    """Counts the iterations of the extension's solver."""

    def __init__(self):
        # The extension imports it at its first use, which is later.
        [package] = [name for name in sys.modules if name.endswith(".cubic_craft.solver")]
        solver = importlib.import_module(f"{package}.stylization").Stylization
        self.iterations = 0
        self._global_step = solver.global_step
        solver.global_step = lambda stylization: self.count(stylization)

    def count(self, stylization):
        self.iterations += 1
        self._global_step(stylization)


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


def measure(path, counter, cuts=0):
    obj = load(path, cuts)
    name, vertices = obj.name, len(obj.data.vertices)
    yield from gui.wait_redraw()
    yield from gui.open_sidebar("Cubic Craft")
    yield from scene.start_live()
    yield from scene.wait_idle()
    slider = yield from gui.find_button("cubic_craft_live.cubeness")
    watch = Stopwatch(scene.live().current())
    properties = bpy.context.window_manager.cubic_craft_live
    last, begin = properties.cubeness, time.monotonic()
    counter.iterations = 0
    ends = 0.2, 0.8
    while time.monotonic() - begin < SECONDS:
        drag = gui.drag(slider.at(ends[0]), slider.at(ends[1]), steps=24)
        ends = ends[::-1]
        for turn in drag:
            if properties.cubeness != last:
                last = properties.cubeness
                watch.changed()
            yield turn
    done = counter.iterations
    seconds = time.monotonic() - begin
    yield from gui.screenshot(f"{name}.png")
    yield from scene.press("ESC")
    yield from gui.wait_until(scene.is_over, what="the end")
    return {
        "mesh": name,
        "vertices": vertices,
        "ticks": watch.ticks,
        "seconds": seconds,
        "iterations_per_second": done / seconds,
        "iterations_per_second_of_ticks": done / sum(watch.ticks),
        "delays": watch.delays,
        "delays_of_ticks": watch.delays_of_ticks,
    }


def test():
    gui.simplify_viewport()
    rows, counter = [], Counter()
    paths = sorted([*FOLDER.glob("*.obj"), *FOLDER.glob("*.ply")])
    for path in (1, *(paths or (2, 3))):  # the first is coarse, and is refined
        rows.append((yield from measure(path, counter)))
    if paths:
        rows.append((yield from measure(paths[-1], counter, cuts=1)))  # a large one
    (FOLDER / "ticks.json").write_text(json.dumps(rows))


gui.run(test)
