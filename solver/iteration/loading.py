# SPDX-License-Identifier: GPL-3.0-or-later
"""Load what a first run needs, in short pieces, before anybody waits for it."""

from collections.abc import Iterator

from ..aliases import Device
from ..optional_packages import optional_package


def loading_steps(device: Device = "auto") -> Iterator[None]:
    """Import packages, start the engine and load its kernels, one step at a time.

    `device`: of the run to come. Between two steps, of a tenth to half of a second, the caller can
    do something else, such as drawing; the last takes twice that where kernels have not been
    compiled on this machine before. What is missing or does not work is left to the run that needs
    it, which reports it.

    Examples
    --------
    >>> from solver import loading_steps
    >>> for _ in loading_steps("numpy"):
    ...     pass  # draw
    """
    for step in (_import_packages(), _start_engine(device), _solve_little(device)):
        try:
            yield from step
        except Exception:  # a broken installation can raise anything
            continue


def _import_packages():
    import scipy.sparse.linalg

    yield
    import scipy.spatial  # noqa: F401

    yield
    optional_package("cholespy")
    yield


def _start_engine(device):
    from ..backends import engine, taichi_runtime

    if device in ("auto", "cpu"):
        engine.import_engine()
        yield
        taichi_runtime.start("cpu")
        yield


def _solve_little(device):
    import numpy as np

    from ..one_call import stylize
    from ..proxy import PAPER, ProxyOptions

    V = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    F = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    for proxy in (PAPER, ProxyOptions()):
        stylize(V, F, 0.4, max_iterations=2, proxy=proxy, device=device)
        yield
