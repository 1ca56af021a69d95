# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify and Live with the device GPU; by `make test-gpu`, which finds one."""

import os

import bpy
import numpy as np
import pytest
from live_steps import bits, check_gone, confirm, tick_to_rest
from rich_mesh import position_of
from scene import add_triangles, cubify, select

pytestmark = pytest.mark.skipif(
    "gpu" not in os.environ.get("CUBIC_CRAFT_DEVICES", ""), reason="make test-gpu runs it"
)
UNTIL_IT_ENDS = {"cubeness": 0.5, "max_iterations": 500}


def on_the_gpu(obj):
    """Tell whether the last run of an object was on a GPU."""
    return "taichi-" in obj.cubic_craft.status and "taichi-cpu" not in obj.cubic_craft.status


def test_cubify_gives_the_shape_of_numpy_and_restore_the_original_bits():
    twin, obj = add_triangles(), add_triangles()
    original = bits(obj)
    assert cubify(device="GPU", **UNTIL_IT_ENDS) == {"FINISHED"}
    assert on_the_gpu(obj)
    made = position_of(obj.data)
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert bits(obj) == original
    select(twin)
    assert cubify(device="NUMPY", **UNTIL_IT_ENDS) == {"FINISHED"}
    moved = np.abs(position_of(twin.data) - position_of(obj.data)).max()
    apart = np.abs(made - position_of(twin.data)).max(axis=1)
    assert np.quantile(apart, 0.95) < 0.05 * moved  # a triangle between two sides may go either way


def test_live_leaves_the_bits_of_cubify(live, begin):
    twin, obj = add_triangles(), add_triangles()
    session = tick_to_rest(begin(obj, device="GPU", cubeness=0.2))
    live.live_properties().cubeness = 0.5
    confirm(live, session)
    check_gone(live)
    assert on_the_gpu(obj)
    select(twin)
    cubify(device="GPU", **UNTIL_IT_ENDS)
    assert on_the_gpu(twin)
    assert bits(obj) == bits(twin)
