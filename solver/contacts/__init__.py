# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces that do not cross at rest do not cross in the result.

`crossings.py` finds the triangles that cross, `pairs.py` where surfaces have to be held apart, and
`push.py` moves apart the few that still cross; `keep_apart.py` is the sequence of all three.
"""
