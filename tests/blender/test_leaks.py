# SPDX-License-Identifier: GPL-3.0-or-later
"""Again and again: memory, data-blocks, attributes and handlers do not grow.

``CUBIC_CRAFT_ROUNDS=1000`` for the number of rounds with Cubify; a fifth of it with Live.
"""

import gc
import os
from pathlib import Path

import bpy
import pytest
from live_steps import add_monkey, confirm, tick_to_rest
from scene import cubify, select
from world import block_names

ROUNDS = int(os.environ.get("CUBIC_CRAFT_ROUNDS", "30"))
WARM_UP = 20
# Per round, once warm: far below one copy of the positions of the mesh (507 vertices, 6 KiB).
BYTES_PER_ROUND = 4096
SLACK = 8 << 20  # what the allocator may keep, whatever the number of rounds


def resident():
    """Return the bytes of memory that the process occupies."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def counted(obj):
    handlers = {
        name: len(items)
        for name in dir(bpy.app.handlers)
        if isinstance(items := getattr(bpy.app.handlers, name), list)
    }
    names = sorted(attribute.name for attribute in obj.data.attributes)
    return block_names(), handlers, names, list(obj.data.keys()), obj.data.shape_keys is None


def repeat(obj, one_round, rounds):
    """Do rounds, the first of them to warm up, and check that nothing grows."""
    before = counted(obj)
    for _ in range(WARM_UP):
        one_round()
    assert counted(obj) == before
    first = resident()
    for _ in range(rounds):
        one_round()
    growth = resident() - first
    assert counted(obj) == before
    assert growth < SLACK + BYTES_PER_ROUND * rounds, f"{growth} bytes in {rounds} rounds"


needs_proc = pytest.mark.skipif(
    not Path("/proc/self/statm").exists(), reason="memory is asked of Linux"
)


@needs_proc
@pytest.mark.parametrize(
    ("result", "device"),  # each of both: what writes the result knows nothing of the device
    [("MESH", "AUTO"), ("SHAPE_KEY", "NUMPY"), ("NEW_OBJECT", "NUMPY")],
)
def test_cubify_and_restore(result, device):
    obj = add_monkey()

    def one_round():
        cubify(result=result, max_iterations=2, device=device)
        if result == "NEW_OBJECT":
            made = bpy.context.object
            mesh = made.data
            bpy.ops.cubic_craft.show_source()
            bpy.data.objects.remove(made)
            bpy.data.meshes.remove(mesh)
            select(obj)
        else:
            bpy.ops.cubic_craft.restore()

    repeat(obj, one_round, ROUNDS)


@needs_proc
@pytest.mark.parametrize("end", ["CONFIRM", "CANCEL"])
def test_live_sessions(live, begin, end):
    obj = add_monkey()
    obj.cubic_craft.max_iterations = 3

    def one_round():
        session = begin(obj, cubeness=0.5)
        live.live_properties().cubeness = 0.7
        tick_to_rest(session)
        if end == "CONFIRM":
            confirm(live, session)
            bpy.ops.cubic_craft.restore()
        else:
            session.on(live.Event.CANCEL)

    repeat(obj, one_round, ROUNDS // 5)
