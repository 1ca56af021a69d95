# SPDX-License-Identifier: GPL-3.0-or-later
"""A program: stylize a small sphere without Blender and print the time of day when that is done.

Run as ``python first_result_solver.py ROOT``, in a process of its own.
"""

import sys
import time

sys.path.insert(0, sys.argv[1])

import numpy as np

from solver import stylize

SEGMENTS, RINGS = 32, 16


def sphere():
    """Return V and F of a sphere of meridians and parallels."""
    polar = np.linspace(0, np.pi, RINGS + 1)[1:-1, None]
    around = np.arange(SEGMENTS) * (2 * np.pi / SEGMENTS)
    x, y = np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around)
    z = np.broadcast_to(np.cos(polar), x.shape)
    V = np.concatenate([np.stack([x, y, z], axis=-1).reshape(-1, 3), [[0, 0, 1], [0, 0, -1]]])
    here = np.arange(x.size).reshape(x.shape)
    beside = np.roll(here, -1, axis=1)
    top, bottom = np.full(SEGMENTS, x.size), np.full(SEGMENTS, x.size + 1)
    corners = [
        (here[:-1], here[1:], beside[1:]),
        (here[:-1], beside[1:], beside[:-1]),
        (top, here[0], beside[0]),
        (bottom, beside[-1], here[-1]),
    ]
    return V, np.concatenate([np.stack([a.ravel() for a in c], axis=1) for c in corners])


stylize(*sphere(), 0.4)
print(f"done at {time.time()}", flush=True)
