# SPDX-License-Identifier: GPL-3.0-or-later
"""From files to objects in Blender, with the vertices of the files."""
