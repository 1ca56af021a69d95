# SPDX-License-Identifier: GPL-3.0-or-later
"""The local step on different machinery, behind one interface: see `NumpyLocalStep`."""

from .choice import DEVICES, local_step_class
from .taichi_runtime import set_cache_folder

__all__ = ["DEVICES", "local_step_class", "set_cache_folder"]
