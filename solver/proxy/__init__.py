# SPDX-License-Identifier: GPL-3.0-or-later
"""From the artist's surface to the proxy that is solved instead, and back.

The energy of the paper assumes one closed surface with a fine, even triangulation. Artists' meshes
have seams, loose parts, clothes and cages of twenty vertices. The solver therefore works on a
*proxy*: the same surface welded (`weld`), fine enough (`refinement`), linked to its neighbors
(`neighbors`) and to its opposite side (`thickness`). `InputMap` maps from the vertices of the
input to those of the proxy and back. With everything off, the proxy is the input itself.
"""

from .input_map import InputMap
from .links import Links, no_links
from .options import PAPER, ProxyOptions
from .surface import Surface, surface_of

__all__ = ("PAPER", "InputMap", "Links", "ProxyOptions", "Surface", "no_links", "surface_of")
