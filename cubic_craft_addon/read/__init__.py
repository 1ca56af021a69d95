# SPDX-License-Identifier: GPL-3.0-or-later
"""From an object in Blender to a piece for the solver; nothing here changes anything.

``member`` reads an object, ``object_frame`` says where it is solved and what it is turned toward
there, and the other modules read one thing each.
"""
