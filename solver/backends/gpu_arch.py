# SPDX-License-Identifier: GPL-3.0-or-later
"""Find a GPU for the engine without risking the process."""

import os
import subprocess
import sys
from functools import cache

from ..errors import CubicCraftError
from .engine_choice import engine

_PROBE = "import {} as ti; ti.init(arch=ti.vulkan, enable_fallback=False)"
_PROBE_SECONDS = 60


def gpu_arch(ti):
    """Return the engine's arch of the best GPU: CUDA, Metal or Vulkan.

    Raises CubicCraftError: there is none.
    """
    core = ti._lib.core
    for arch, is_there in ((ti.cuda, core.with_cuda), (ti.metal, core.with_metal)):
        if is_there():
            return arch
    if _vulkan_starts():
        return ti.vulkan
    raise CubicCraftError(
        f"no GPU that {engine().name} can use was found; choose the device auto, cpu or numpy"
    )


@cache
def _vulkan_starts():
    """Return whether the engine starts on Vulkan, by trying it in another process.

    Where the driver is missing or broken, even asking whether Vulkan is there crashes the process,
    and in Blender the artist's work with it.
    """
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(path for path in sys.path if path),
        "TI_SKIP_VERSION_CHECK": "ON",
    }
    try:
        probe = subprocess.run(
            [sys.executable, "-c", _PROBE.format(engine().package)],
            env=environment,
            capture_output=True,
            timeout=_PROBE_SECONDS,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired):
        return False
    return probe.returncode == 0
