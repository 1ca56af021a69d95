# SPDX-License-Identifier: GPL-3.0-or-later
"""A complete run in one call: of a mesh, or of a Stylization."""

import logging
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from .aliases import Device, Faces, Precision
from .inputs import switch
from .iteration.options import SolverOptions
from .iteration.pose import Pose
from .iteration.progress import progress_bar
from .iteration.result import Result
from .iteration.runner import OnIteration, Run
from .iteration.setup import Setup
from .iteration.stylization import Stylization
from .limbs import KnownLimbs
from .mesh.mesh_checks import check_mesh, check_winding
from .proxy import PAPER, ProxyOptions
from .styles.admm import AdmmOptions
from .styles.polytope import Polytope
from .styles.style import CRISPNESS, Style
from .surface.preparation import rest_mesh

_log = logging.getLogger(__name__)


def stylize(
    V: ArrayLike,
    F: Faces,
    cubeness: ArrayLike = 0.4,
    pinned: ArrayLike = (),
    *,
    proxy: ProxyOptions | None = None,
    crispness: ArrayLike | None = None,
    keep_rotation: bool | None = None,
    form: str | Polytope | Sequence[str | Polytope] | None = None,
    form_of: ArrayLike | None = None,
    orientation: ArrayLike | None = None,
    detail_strength: ArrayLike = 1.0,
    targets: ArrayLike | None = None,
    limbs: KnownLimbs | None = None,
    max_iterations: int = 1000,
    tolerance: float = 1e-3,
    on_iteration: OnIteration | None = None,
    progress: bool = False,
    device: Device = "auto",
    precision: Precision | None = None,
    admm: AdmmOptions | None = None,
    is_accelerated: bool = True,
) -> Result:
    """Return the cubic version of a mesh.

    All is as in Blender, unless it is told otherwise.

    Parameters
    ----------
    V : (n,3) numpy array
        Rest positions, in any unit. Vertices that belong to no triangle do not move.
    F : (m,3) numpy int array, or faces with more corners
        Triangles. Polygons (m,s), or rows of any length, are split into triangles.
    cubeness : float or (n,) numpy array
        0 keeps the shape; 0.1 to 1 are common.
    pinned : (k,) numpy int array or (n,) numpy bool array
        Vertices held exactly in place: their numbers, or a mask.
    proxy : ProxyOptions, optional
        How to prepare the surface: weld it, refine it, and link it to its neighbors and its
        opposite side. By default as in the extension; `PAPER` is the method of the paper, on the
        surface exactly as it is.
    crispness : float or (n,) numpy array, optional
        From 0 to 1: how far sides are made flat and edges straight in the end. By default 0.9; with
        `PAPER`, 0.
    keep_rotation : bool, optional
        Whether each component keeps its orientation, see `SolverOptions`. By default it does; not
        with `PAPER`.
    form : str, Polytope or sequence of them, optional
        What a ball would become, such as "octahedron"; by default the cube. `styles.forms` has all.
    form_of, orientation, detail_strength
        As of `Style`.
    targets, limbs
        As of `Pose`: where the pinned vertices go, and limbs that are known.
    max_iterations : int
        Limit, even if the run has not converged.
    tolerance : float
        See `StopRule`.
    on_iteration : callable, optional
        Called with the Stylization after each iteration, also on coarser meshes (`is_coarse`); a
        true value cancels the run.
    progress : bool
        Whether to show a progress bar on standard error.
    device, precision, admm, is_accelerated
        As of `SolverOptions`: what computes, and how.

    Returns
    -------
    Result

    Raises
    ------
    CubicCraftError
        The mesh or an option is invalid; the message gives the reason.

    Notes
    -----
    Minimizes the energy of Liu and Jacobson, "Cubic Stylization", ACM Transactions on Graphics
    38(6), 2019.

    Examples
    --------
    A ball becomes a cube: nearly all of its surface then faces an axis.

    >>> import numpy as np
    >>> from solver import PAPER, ball, stylize, triangle_areas_and_normals
    >>> V, F = ball()
    >>> result = stylize(V, F, 0.6, device="numpy")
    >>> for positions in (V, result.positions):
    ...     areas, normals = triangle_areas_and_normals(positions, F)
    ...     faces_an_axis = np.abs(normals).max(axis=1) > 0.98  # within 11 degrees
    ...     print(f"{areas[faces_an_axis].sum() / areas.sum():.2f} of the area")
    0.06 of the area
    1.00 of the area

    A form with a name, and the method of the paper:

    >>> gem = stylize(V, F, form="octahedron", device="numpy")
    >>> soft = stylize(V, F, 0.6, proxy=PAPER, device="numpy")
    """
    points, triangles = check_mesh(V, F)
    check_winding(triangles, len(points))
    proxy = ProxyOptions() if proxy is None else proxy
    is_paper = proxy == PAPER
    setup = Setup(rest_mesh(points, F, proxy), pinned)
    style = Style(
        cubeness,
        np.eye(3) if orientation is None else orientation,
        form,
        form_of=form_of,
        crispness=(0.0 if is_paper else CRISPNESS) if crispness is None else crispness,
        detail_strength=detail_strength,
    )
    options = SolverOptions(
        device=device,
        precision=precision,
        admm=admm,
        is_accelerated=is_accelerated,
        keep_rotation=not is_paper if keep_rotation is None else keep_rotation,
    )
    stylization = Stylization(setup, style, Pose(targets=targets, limbs=limbs), options)
    return run(stylization, max_iterations, tolerance, on_iteration, progress)


def run(
    stylization: Stylization,
    max_iterations: int = 1000,
    tolerance: float = 1e-3,
    on_iteration: OnIteration | None = None,
    progress: bool = False,
) -> Result:
    """Iterate a new Stylization to its end.

    Parameters
    ----------
    stylization : Stylization
    max_iterations, tolerance, on_iteration, progress
        As for `stylize`.

    Returns
    -------
    Result

    Raises
    ------
    CubicCraftError
        The tolerance is not positive, or max_iterations is no whole number from 1.

    Examples
    --------
    How far the surface moves, with one factorization for three values of cubeness:

    >>> import numpy as np
    >>> from solver import Setup, SolverOptions, Stylization, ball, rest_mesh, run
    >>> V, F = ball()
    >>> setup = Setup(rest_mesh(V, F))
    >>> options = SolverOptions(keep_rotation=True, device="numpy")
    >>> for cubeness in (0.0, 0.1, 0.6):
    ...     result = run(Stylization(setup, cubeness, options=options))
    ...     print(f"{np.linalg.norm(result.positions - V, axis=1).max():.2f}")
    0.00
    0.17
    0.26
    """
    steps = Run(stylization, max_iterations, tolerance)
    if switch(progress, "progress"):
        with progress_bar(max_iterations, tolerance) as update:
            steps.complete(lambda state: update(state) or (on_iteration and on_iteration(state)))
    else:
        steps.complete(on_iteration)
    result = steps.result()
    _log.info(
        "%s after %d iterations, energy %.6g, %s, %.2f s",
        *(result.reason, result.iterations, result.energy.total, result.device),
        result.solve_seconds,
    )
    return result
