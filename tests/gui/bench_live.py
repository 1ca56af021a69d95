# SPDX-License-Identifier: GPL-3.0-or-later
"""How long the ticks of Live take while its slider is dragged; run by scripts/benchmark_live.py.

For each mesh in /share it drags for ten seconds, and writes to /share/ticks.json what each tick
took and how long each change took to be seen. Blender's own drawing is not part of either.
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
    """Times every tick of a session, and what passes from a change to a shape that shows it."""

    def __init__(self, session):
        self.ticks, self.delays = [], []
        self._session, self._changed_at = session, None
        self._tick, session.tick = session.tick, self.tick

    def changed(self):
        if self._changed_at is None:
            self._changed_at = time.perf_counter()

    def tick(self, context):
        begin = time.perf_counter()
        shown = self._session._has_written
        self._session._has_written = False
        self._tick(context)
        end = time.perf_counter()
        self.ticks.append(end - begin)
        if self._session._has_written and self._changed_at is not None:
            self.delays.append(end - self._changed_at)
            self._changed_at = None
        self._session._has_written |= shown


def load(path):
    with gui.in_region():
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        read = bpy.ops.wm.ply_import if path.suffix == ".ply" else bpy.ops.wm.obj_import
        read(filepath=str(path))
        obj = bpy.context.selected_objects[0]
        bpy.context.view_layer.objects.active = obj
        size = max(obj.dimensions)
        obj.scale = (3 / size,) * 3
        bpy.ops.ed.undo_push(message="Load")
    return len(obj.data.vertices)


def measure(path):
    vertices = load(path)
    yield from gui.open_sidebar("Cubic Craft")
    yield from scene.start_live()
    yield from scene.wait_idle()
    slider = yield from gui.find_button("cubic_craft_live.cubeness")
    watch = Stopwatch(scene.live().current())
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
    yield from gui.screenshot(f"{path.stem}.png")
    yield from scene.press("ESC")
    yield from gui.wait_until(scene.is_over, what="the end")
    return {"mesh": path.name, "vertices": vertices, "ticks": watch.ticks, "delays": watch.delays}


def test():
    gui.simplify_viewport()
    rows = []
    for path in sorted([*FOLDER.glob("*.obj"), *FOLDER.glob("*.ply")]):
        rows.append((yield from measure(path)))
    (FOLDER / "ticks.json").write_text(json.dumps(rows))


gui.run(test)
