# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of a Stylization that are not of the shape that is looked for."""

from dataclasses import dataclass

from ..aliases import Device, Precision
from ..inputs import instance, switch
from ..styles.admm import AdmmOptions


@dataclass(frozen=True, kw_only=True)
class SolverOptions:
    """How a shape is solved, by a `Stylization`, which also finds whether the device is available.

    Raises
    ------
    CubicCraftError
        An option has another type. That a device is not available is found by the
        `Stylization`.

    Examples
    --------
    >>> from solver import SolverOptions
    >>> upright = SolverOptions(keep_rotation=True)
    >>> upright.device, upright.is_accelerated
    ('auto', True)
    """

    device: Device = "auto"
    """"auto", "cpu", "gpu" or "numpy". On a GPU, the arrays stay there; if the engine is reset
    during a run, every method that needs them raises a CubicCraftError"""
    precision: Precision | None = None
    """"f64" or "f32", of the local step in Taichi; by default the highest that the device
    supports"""
    admm: AdmmOptions | None = None
    """where the exact local step is not used; by default `AdmmOptions()`"""
    is_accelerated: bool = True
    """False for the plain iteration, in which the energy falls in every step"""
    keep_rotation: bool = False
    """whether each component without pins keeps its orientation, and so does each of its large
    parts (`upright_parts`). Otherwise it may turn as a whole to fit the form"""

    def __post_init__(self):
        switch(self.is_accelerated, "is_accelerated")
        switch(self.keep_rotation, "keep_rotation")
        if self.admm is not None:
            instance(self.admm, "admm", AdmmOptions)
