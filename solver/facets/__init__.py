# SPDX-License-Identifier: GPL-3.0-or-later
"""The sides of a shape as regions with a plane each, and as polygons.

`regions` parts the surface into them, `outlines` finds their borders with few vertices, and
`polygons` fills these. `low_poly` divides them at seams before, and puts all together.
"""
