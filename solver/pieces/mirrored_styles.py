# SPDX-License-Identifier: GPL-3.0-or-later
"""The form beyond a plane of symmetry: the mirror image of the form on this side."""

import numpy as np

from ..aliases import FloatArray
from .placement import Placement
from .reflection import Reflection
from .whole import Whole

_ALIKE = 1e-5  # smaller rotations make no difference


def orientations(whole: Whole, placement: Placement) -> list[FloatArray]:
    """Return the orientation of each style for all vertices (1,3,3), or for each of them (N,3,3).

    One for all if each form is its own image about every plane. Otherwise those beyond a plane are
    reflections.
    """
    turns = [np.eye(3)]
    for reflection in whole.mirrored:
        turns += [turn @ _placed(reflection, placement) for turn in turns]
    axes = [np.asarray(style.orientation) for style in placement.styles]
    if all(_look_alike(turn, placement) for turn in turns):
        return [Q[None] for Q in axes]
    sides = whole.sides()
    return [np.stack([Q @ turn for turn in turns])[sides] for Q in axes]


def is_own_image(
    reflection: Reflection, placement: Placement, direction: FloatArray | None = None
) -> bool:
    """Return whether forms, and a direction (3,), are their own images about a plane."""
    turn = _placed(reflection, placement)
    if np.abs(_mapped(reflection, placement) - turn).max() > _ALIKE:
        return False  # a stretch aslant to the plane leaves nothing that is symmetric
    if direction is not None and np.abs(turn @ direction - direction).max() > _ALIKE:
        return False
    return _look_alike(turn, placement)


def _mapped(reflection, placement):
    """Return the map (3,3) of a reflection of the object where it is solved."""
    linear = placement.linear @ np.reshape(reflection.linear, (3, 3))
    return linear @ np.linalg.inv(placement.linear)


def _placed(reflection, placement):
    """Return the same without a stretch."""
    U, _, Vt = np.linalg.svd(_mapped(reflection, placement))
    return U @ Vt


def _look_alike(turn, placement):
    for style in placement.styles:
        Q = np.asarray(style.orientation)
        if not looks_alike(Q @ turn @ Q.T, style.form):
            return False
    return True


def looks_alike(turn, form):
    """Return whether the form looks the same after a turn or reflection."""
    if form is not None:
        costs = form.cost(form.normals @ turn.T)
        return bool(np.abs(costs - form.offsets).max() <= _ALIKE * form.radius)
    sizes = np.abs(turn)
    return np.minimum(sizes, np.abs(sizes - 1.0)).max() <= _ALIKE
