# SPDX-License-Identifier: GPL-3.0-or-later
"""The environment of CubicCraft: Blender's modes, installed packages, the cache of kernels."""
