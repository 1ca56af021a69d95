# SPDX-License-Identifier: GPL-3.0-or-later
"""Hardening: from the soft cubic shape on, sides become flat and edges straight.

`base` finds the surface without its details and their heights above it, `sides` which side of the
form each triangle belongs to, and `face_step` is the local step of an iteration in which these
stay as they are. `rims` finds the narrow sides that give a shape its outline, `borders` makes
straight what runs between sides, and `hardening` puts them together. `hard_stylization` iterates.
"""
