# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame of the form at each vertex, in which limbs keep their direction."""

import numpy as np
from numpy.typing import ArrayLike

from ..aliases import Faces, FloatArray
from ..options import SolverOptions
from ..preparation import rest_mesh
from ..proxy.options import ProxyOptions
from ..setup import Setup
from ..styles.style import Style
from ..stylization import Stylization


def pose_frames(
    V: ArrayLike, F: Faces, orientation: ArrayLike | None = None, proxy: ProxyOptions | None = None
) -> FloatArray:
    """Return the orientations in which the limbs of a mesh keep their direction.

    Parameters
    ----------
    V : (n,3) numpy array
        Rest positions, in any unit.
    F : (m,3) numpy int array
        Triangles.
    orientation : (3,3) numpy array, optional
        Rotation that maps a vector into the frame of the form, where there is no limb.
    proxy : ProxyOptions, optional
        How to prepare the surface; by default as in the extension.

    Returns
    -------
    (n,3,3) numpy array
        As a `Style` has it, and as `Stylization` uses it by itself with `ProxyOptions.keep_pose`.

    Raises
    ------
    CubicCraftError
        The mesh or the orientation is invalid.

    See Also
    --------
    stylize : Its ``orientation``.

    Examples
    --------
    A ball that is drawn out along a line 30 degrees from Z is a limb, and its form leans with it:

    >>> import numpy as np
    >>> from solver import ball, pose_frames
    >>> V, F = ball()
    >>> c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    >>> limb = V * [0.2, 0.2, 1] @ np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]])
    >>> up = pose_frames(limb, F)[350].T @ [0, 0, 1]  # in the middle
    >>> f"{np.degrees(np.arccos(up[2])):.0f} degrees"
    '30 degrees'
    """
    setup = Setup(rest_mesh(V, F, proxy or ProxyOptions()))
    style = Style(0.0, np.eye(3) if orientation is None else orientation)
    options = SolverOptions(device="numpy", keep_rotation=True)
    return Stylization(setup, style, options=options).orientations
