# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line: ``blender -c cubic_craft bunny.obj --cubeness 0.4``.

`blender_command` is what Blender calls, and ``scripts/headless_render.py`` calls the same `main`
where the extension is not installed. Until a file is read, nothing else imports bpy: --help,
mistyped options and the process that hands out the files of a batch need none.
"""
