# SPDX-License-Identifier: GPL-3.0-or-later
"""Hypothesis strategy for the options of a run, sound ones, for any mesh."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from hostile_meshes import SEEDS
from hypothesis import strategies as st

from solver import PAPER, ProxyOptions

CUBENESS = (0.4, 0.0, 1e-6, 0.2, 1.0, 10.0)
APART = {"keep_apart": False}  # its rounds take several times as long as the rest
PROXIES = {
    "paper": PAPER,
    "default": ProxyOptions(),
    "solid": ProxyOptions(solidity=10.0, **APART),
    "hollow": ProxyOptions(solidity=0.0),
    "turned": ProxyOptions(keep_pose=False, **APART),
    "without details": ProxyOptions(detail=0.0, **APART),
    "large details": ProxyOptions(detail=1.0, **APART),
    "each alone": ProxyOptions(together=False),
    "not refined": ProxyOptions(refine=False, **APART),
}
_TURNS = (np.eye(3), np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0], [0.48, 0.64, 0.6]]))


@dataclass
class Options:
    """How a mesh is stylized."""

    cubeness: Any
    pinned: Any
    targets: Any
    """(n,3) positions of the pinned, or None"""
    orientation: Any
    keep_rotation: bool
    proxy: ProxyOptions
    notes: str

    def __repr__(self):
        """Tell how they were made."""
        return f"<{self.notes}>"

    def _repr_pretty_(self, printer, cycle):
        printer.text(repr(self))  # Hypothesis would print all fields


@st.composite
def options_for(draw, mesh):
    """Draw Options for a BrokenMesh."""
    n = len(mesh.V)
    kind = draw(st.sampled_from(["number", "map"]))
    cubeness = draw(st.sampled_from(CUBENESS))
    pins = draw(st.sampled_from(["none", "one", "some", "loose", "all but one"]))
    pose = (
        draw(st.sampled_from(["rest", "moved", "collapsed", "far"])) if pins != "none" else "rest"
    )
    turn = draw(st.integers(0, len(_TURNS) - 1))
    keep_rotation, seed = draw(st.booleans()), draw(SEEDS)
    proxy = draw(st.sampled_from(sorted(PROXIES)))
    rng = np.random.default_rng(seed)
    lam = cubeness * rng.choice([0.0, 0.5, 1.0], n) if kind == "map" else cubeness
    free = np.flatnonzero(~mesh.loose)[0]
    pinned = {
        "none": [],
        "one": np.setdiff1d(rng.integers(0, n, 1), free),
        "some": np.setdiff1d(np.flatnonzero(rng.random(n) < 0.3), free),
        "loose": np.flatnonzero(mesh.loose),
        "all but one": np.delete(np.arange(n), free),
    }[pins]
    notes = f"{kind} {cubeness}, pins {pins} {pose}, turn {turn}, keep {keep_rotation}, {proxy}"
    return Options(
        lam,
        np.asarray(pinned, int),
        _targets(mesh.V, pose, rng),
        _TURNS[turn],
        keep_rotation,
        PROXIES[proxy],
        f"{notes}, seed {seed}",
    )


def _targets(V, pose, rng):
    extent = np.ptp(V, axis=0).max()
    if pose == "moved":
        return V + 0.2 * extent * rng.normal(size=V.shape)
    if pose == "collapsed":
        return np.tile(V[0], (len(V), 1))
    return V + 1e3 * extent if pose == "far" else None
