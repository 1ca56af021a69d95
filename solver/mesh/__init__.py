# SPDX-License-Identifier: GPL-3.0-or-later
"""The geometry of a triangle mesh: edges, triangles, cotangents, components, distances, checks."""
