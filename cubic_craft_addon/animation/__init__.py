# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify Animation: the cubic version of each frame, baked and played back.

``animated`` reads and solves a frame, ``recording`` keeps what is solved in a folder, ``bake`` is
the work of a click, and ``playback`` makes the baked objects play the ``point_cache``.
"""
