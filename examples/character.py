# SPDX-License-Identifier: GPL-3.0-or-later
"""A character with eyes of its own: made cubic together, they stay in their places.

Run it with the extension enabled: blender -b -P examples/character.py -- character.png
"""

import sys
from pathlib import Path

import bpy

sys.path.append(str(Path(__file__).parent))
from studio import NEXT, empty_scene, eyes, figure, paint, select, take_picture

empty_scene()
for number, cubeness in enumerate((0.0, 0.2, 0.6)):
    body, pair = figure(number * NEXT), eyes(number * NEXT)
    paint([body], 0.5, 0.2, 0.1)
    paint([pair], 0.9, 0.9, 0.9)
    select([body, pair])  # selected together, they are solved as one
    bpy.ops.cubic_craft.cubify(cubeness=cubeness)
take_picture()
