# SPDX-License-Identifier: GPL-3.0-or-later
"""Play frames at an even speed: equal steps of the largest movement of any vertex."""

from collections.abc import Iterable

import numpy as np


def largest_steps(pieces: Iterable[np.ndarray]) -> np.ndarray:
    """Return how far the farthest vertex moves from each frame to the next, (f-1,).

    `pieces`: iterable of (f,k,3), positions of some vertices each, in all frames.
    """
    steps = [np.linalg.norm(np.diff(piece, axis=0), axis=2).max(axis=1) for piece in pieces]
    return np.max(steps, axis=0)


def even_places(steps: np.ndarray, count: int) -> np.ndarray:
    """Return where in the frames `count` frames at even speed lie, (count,) from 0 to f-1."""
    way = np.concatenate([[0.0], np.cumsum(steps)])
    if not way[-1] > 0.0:
        return np.zeros(count)
    is_step = np.append(True, np.diff(way) > 0.0)  # what does not move takes no time
    return np.interp(np.linspace(0.0, way[-1], count), way[is_step], np.flatnonzero(is_step))


def resampled(frames: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Return positions (f,k,3) at places between the frames (count,), as (count,k,3)."""
    begin = np.minimum(places.astype(int), len(frames) - 1)
    end = np.minimum(begin + 1, len(frames) - 1)
    share = (places - begin)[:, None, None]
    return (1.0 - share) * frames[begin] + share * frames[end]
