# SPDX-License-Identifier: GPL-3.0-or-later
"""What the command line needs that is not Blender's; neither NumPy nor bpy."""
