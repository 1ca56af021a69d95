# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame of the form at each vertex, in which limbs keep their direction."""

from numpy.typing import ArrayLike

from ..aliases import Faces, FloatArray
from ..proxy.options import ProxyOptions
from ..rest import rest_mesh
from ..setup import Setup
from ..stylization import Stylization


def pose_frames(
    V: ArrayLike,
    F: Faces,
    orientation: ArrayLike | None = None,
    proxy: ProxyOptions | None = None,
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
        As `Stylization` takes it, and as it uses it by itself with `ProxyOptions.keep_pose`.

    Raises
    ------
    CubicCraftError
        The mesh or the orientation is invalid.

    See Also
    --------
    stylize : Its ``orientation``.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import pose_frames
    >>> V = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> F = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    >>> pose_frames(V, F).shape
    (4, 3, 3)
    """
    setup = Setup(rest_mesh(V, F, proxy or ProxyOptions()))
    return Stylization(setup, 0.0, orientation, device="numpy", keep_rotation=True).orientations
