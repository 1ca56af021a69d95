# SPDX-License-Identifier: GPL-3.0-or-later
"""What --help says."""

import argparse

from ....solver.console.sources import listing
from .formats import ANIMATED, READABLE, WRITABLE

COMMON = (
    *("inputs", "--cubeness", "--form", "--orientation", "--pin", "--crispness", "--detail"),
    *("--output", "--no-render", "--save-mesh", "--low-poly", "--bake"),
    *("--output-folder", "--jobs", "--turn"),
)
"""what --help shows; --help-all shows all"""

HELP = {
    "inputs": f"{listing(READABLE)}; without it, Blender's monkey, subdivided; for a batch several "
    "files, or folders of them",
    "--object": "this mesh object only (default: all that are shown and rendered)",
    "--threads": "of the processor (default: all of them, in a batch shared by its jobs)",
    "--timeout": "for each file: one that takes longer is given up (default: none)",
    "--worker": argparse.SUPPRESS,
    "--child": argparse.SUPPRESS,
    "--verbose": "show Blender's own messages",
    "--form-object": "for --form object the file whose convex hull is the form, for directions the "
    "one whose faces are, about the origin of its scene",
    "--region": "a vertex group with a form and a cubeness of its own, such as head:octahedron:0.8 "
    "or, with a number of sides, hat:prism5:1; where its weights are less than 1, it blends into "
    "the rest",
    "--capture": "file with a ball whose normals say which way a surface should face that faces as "
    "its vertices do from the origin of its scene",
    "--pin": "vertex groups that stay in place",
    "--handles": "parts of the mesh that are held or moved, see below",
    "--symmetry": "x, y, z or several: halves that are mirror images about the object's origin "
    "stay so; auto: those that are so in 99 %%, of a mesh or of what is solved together; off "
    "(default: auto)",
    "--with-modifiers": "take what is seen: meshes with their modifiers applied, texts, curves, "
    "surfaces and metaballs as meshes",
    "--output": "(default: cubic_craft.png)",
    "--no-render": "no picture",
    "--save-mesh": f"the result: {listing(WRITABLE)}; with several cubeness values one file each "
    "(name_0.4.obj); in a batch the end of the names, such as .obj or _cubic.obj",
    "--low-poly": "levels of detail beside each .glb or .fbx, name_lod1.glb and so on, with so "
    "many triangles and a normal map",
    "--bake": f"the cubic version of each frame of an animation: {listing(ANIMATED)}; instead of "
    "a picture and a mesh; in a batch the end of the names. A run that was ended continues where "
    "it was",
    "--frames": "first and last frame for --bake (default: those of the file)",
    "--part": "for --bake on several machines: solves the Kth of N parts of the frames; when all "
    "are solved, the same command without --part writes the file",
    "--report": "numbers of the run; in a batch written after each file",
    "--output-folder": "for the results, each named as its input; made if it is not there",
    "--recursive": "take folders with the folders in them, and lay the results out alike",
    "--only": "this file of them only, counted from 1: for render farms, where each is a task",
    "--jobs": "files worked on at the same time, each in a Blender of its own (default: 1)",
    "--force": "do also what is done already",
    "--samples": "of cycles; denoised (default: 16)",
    "--resolution": "(default: 1600 540)",
    "--turn": "degrees that stand the objects upright, for files with another idea of up; the "
    "result does not change",
    "--view": "that the objects are turned about the vertical toward the camera (default: 32, or a "
    "quarter or two further where that shows more)",
    "--turntable": "a picture sequence name_0001.png ..., each object turning about its vertical "
    "axis",
}

EPILOG = """\
The picture shows the original beside one result per cubeness.
Several files, or folders of them, go to a folder: --output-folder DIR.
Exit codes: 0 all is done, 2 nothing was begun because of what was given, 3 some files failed,
130 interrupted.
"""
WHOLE_EPILOG = """\
The picture shows the original beside one result per cubeness. With --turntable it becomes a
sequence name_0001.png ... in which every object turns once about its vertical axis.
Orientation 0 0 0 means the axes of the scene, where Z is up; with --space object those of each
object, which for an .obj are those of the file.
Options of Blender itself stand before the command: blender --threads 2 -c cubic_craft [options];
where the extension is not installed: blender -b -P scripts/headless_render.py -- [options]

Several files, or folders of them, go to a folder: --output-folder DIR. A file that cannot be used
does not stop the others. What is there already, made of the same file with the same options, is
kept: start a batch again to go on where it was stopped.
Exit codes: 0 all is done, 2 nothing was begun because of what was given, 3 some files failed,
130 interrupted.

--handles FILE.json poses the mesh: a list of parts to hold, and where; the rest follows.
  [{"box": [[-1, -1, -1], [1, 1, -0.8]]},
   {"group": "ear", "translate": [0, 0, 0.4], "rotate": [0, 30, 0]}]
Each has one of
  "group": name of a vertex group, with "threshold": least weight (0.5)
  "vertices": numbers of vertices in the input file, from 0
  "box": lowest and highest corner; all vertices in it
and any of
  "translate": [x, y, z]      "rotate": degrees about [x, y, z], in this order
  "scale": number or [x, y, z]
  "pivot": [x, y, z] that it is turned and scaled about (the middle of its bounding box)
Coordinates are the object's own, as they stand in the file (for an .obj those of its "v" lines),
before --turn. Without any of these the part stays in place. Where parts overlap the first counts,
--pin before all. --cubeness 0 poses only.
"""
