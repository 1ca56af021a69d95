# SPDX-License-Identifier: GPL-3.0-or-later
"""The devices that the tests run on, and what can be asked of a GPU."""

import os

DEVICES = os.environ.get("CUBIC_CRAFT_DEVICES", "numpy cpu").split()
"""those of the fixture `device`; `make test-gpu` says gpu"""


def by_device(device, usual, on_gpu):
    """Return a tolerance, or another one for a GPU: it computes in 32 bit, and by multigrid."""
    return on_gpu if device == "gpu" else usual
