# SPDX-License-Identifier: GPL-3.0-or-later
"""Types that the annotations of the solver share. Docstrings tell the shapes of arrays."""

from collections.abc import Sequence
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray: TypeAlias = NDArray[np.float64]
RealArray: TypeAlias = NDArray[np.floating[Any]]
IntArray: TypeAlias = NDArray[np.integer[Any]]
BoolArray: TypeAlias = NDArray[np.bool_]

Faces: TypeAlias = ArrayLike | Sequence[ArrayLike]
"""rows of vertex numbers, of one length or of several"""

Device: TypeAlias = Literal["auto", "cpu", "gpu", "numpy"]
"""where the local step runs, see `local_step_class`"""
Precision: TypeAlias = Literal["f64", "f32"]
"""of the local step on a device; NumPy is always f64"""
