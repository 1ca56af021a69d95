# SPDX-License-Identifier: GPL-3.0-or-later
"""From the artist's surface to what is solved in its place, and back.

The energy of the paper knows one closed, evenly and finely triangulated skin. Artists have seams,
loose parts, clothes and cages of twenty vertices. So the solver is handed a *proxy*: the same
surface welded (`weld`), fine enough (`refinement`), linked to its neighbours (`neighbours`) and to
its other side (`thickness`). `InputMap` leads from the vertices of the input to those of the proxy
and back. With all of it off, the proxy is the input itself.
"""

from .input_map import InputMap
from .links import Links, no_links
from .options import PAPER, ProxyOptions
from .surface import Surface, surface_of

__all__ = ("PAPER", "InputMap", "Links", "ProxyOptions", "Surface", "no_links", "surface_of")
