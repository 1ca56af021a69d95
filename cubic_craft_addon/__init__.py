# SPDX-License-Identifier: GPL-3.0-or-later
"""The Blender side that is not an operator.

It imports nothing by itself: the command line reads its options before Blender is started.
"""
