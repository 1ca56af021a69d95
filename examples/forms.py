# SPDX-License-Identifier: GPL-3.0-or-later
"""One monkey, and what it becomes with four forms.

Run it with the extension enabled: blender -b -P examples/forms.py -- forms.png
"""

import sys
from pathlib import Path

import bpy

sys.path.append(str(Path(__file__).parent))
from studio import NEXT, empty_scene, monkey, paint, take_picture

FORMS = ("CUBE", "OCTAHEDRON", "PRISM", "CYLINDER")

empty_scene()
paint([monkey()], 0.5, 0.2, 0.1)
for number, form in enumerate(FORMS, start=1):
    cubic = monkey(number * NEXT)
    bpy.ops.cubic_craft.cubify(cubeness=0.6, form=form)
    paint([cubic], 0.02, 0.3, 0.25)
take_picture()
