# SPDX-License-Identifier: GPL-3.0-or-later
"""No test: Cubify once after installing, so that all tests begin with compiled kernels."""

import bpy
import guidrive as gui


def cubify():
    with gui.in_region():
        bpy.ops.mesh.primitive_monkey_add()
        assert bpy.ops.cubic_craft.cubify() == {"FINISHED"}
    yield


gui.run(cubify)
