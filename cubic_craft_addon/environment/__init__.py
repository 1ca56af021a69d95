# SPDX-License-Identifier: GPL-3.0-or-later
"""What CubicCraft finds itself in: Blender's modes, the packages that are there, Taichi's cache."""
