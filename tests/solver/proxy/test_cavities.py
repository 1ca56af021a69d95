# SPDX-License-Identifier: GPL-3.0-or-later
"""Links across cavities."""

from itertools import pairwise

import numpy as np
import pytest
import shapes

from solver import ProxyOptions, rest_mesh, stylize

OUTLINES = {
    "cup": [(0.02, 0), (0.35, 0), (0.4, 0.05), (0.45, 1), (0.4, 1), (0.35, 0.08), (0.02, 0.06)],
    "single wall": [(0.02, 0), (0.35, 0), (0.4, 0.05), (0.45, 0.6)],
    "post": [(0.02, 0), (0.2, 0), (0.2, 1), (0.02, 1)],
}


def revolved(name, step=0.03, around=64):
    """Return an outline (radius, height), in short steps, turned around the vertical axis."""
    corners = np.array(OUTLINES[name], dtype=float)
    pieces = [corners[:1]]
    for a, b in pairwise(corners):
        count = max(round(np.linalg.norm(b - a) / step), 1)
        pieces.append(a + (b - a) * np.arange(1, count + 1)[:, None] / count)
    radius, height = np.concatenate(pieces).T[..., None]
    angle = np.arange(around) * 2.0 * np.pi / around
    places = [radius * np.cos(angle), radius * np.sin(angle), height + 0.0 * angle]
    V = np.stack(places, axis=-1).reshape(-1, 3)
    ring, k = np.divmod(np.arange(len(V) - around), around)
    a, b = ring * around + k, ring * around + (k + 1) % around
    first, second = (a, b, b + around), (a, b + around, a + around)
    return V, np.concatenate([np.stack(first, axis=1), np.stack(second, axis=1)])


@pytest.mark.parametrize("name", ["cup", "single wall"])
def test_walls_are_linked_across_what_they_enclose(name):
    V, F = revolved(name)
    rest = rest_mesh(V, F, ProxyOptions())
    links = rest.across_cavities
    i, j = links.vertices[:, 0], links.vertices[:, 1]
    middle = rest.box.from_unit((rest.V[i] + rest.V[j]) / 2.0)
    assert len(links) > 40
    assert np.median(np.linalg.norm(middle[:, :2], axis=1)) < 0.1


def test_figures_without_cavities_have_no_such_links():
    for V, F in (shapes.blob(4), shapes.sphere(4), revolved("post")):
        assert not len(rest_mesh(V, F, ProxyOptions()).across_cavities)


def test_a_narrow_boat_stays_open():
    """Without the links it keeps 0.65 of its width, with them 0.79."""
    V, F = revolved("cup", around=96)
    V = V * [2.2, 0.8, 0.6]
    U = stylize(V, F, 0.4, proxy=ProxyOptions(), keep_rotation=True, crispness=0.9).positions
    assert np.ptp(U[:, 1]) > 0.74 * np.ptp(V[:, 1])
