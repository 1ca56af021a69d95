# SPDX-License-Identifier: GPL-3.0-or-later
"""How many examples are tried, and which.

In continuous integration they are always the same ones. `CUBIC_CRAFT_EXAMPLES=50000` (or
`make test-hostile EXAMPLES=50000`) tries so many in all, others in each run; what fails is printed,
kept in ``build/hypothesis`` and tried first the next time.
"""

import os
from pathlib import Path

from hypothesis import HealthCheck, Phase, settings
from hypothesis.database import DirectoryBasedExampleDatabase

IN_ALL = 80
"""examples that all tests together try in continuous integration"""

_WANTED = int(os.environ.get("CUBIC_CRAFT_EXAMPLES", "0"))
_FAILURES = Path(__file__).resolve().parents[2] / "build" / "hypothesis"


def examples(count):
    """Return the settings of a test that tries `count` of the `IN_ALL` examples."""
    is_nightly = _WANTED > 0
    return settings(
        max_examples=max(round(count * _WANTED / IN_ALL), 1) if is_nightly else count,
        derandomize=not is_nightly,
        database=DirectoryBasedExampleDatabase(_FAILURES) if is_nightly else None,
        deadline=None,
        print_blob=True,
        phases=[Phase.explicit, Phase.reuse, Phase.generate, Phase.shrink],
        suppress_health_check=list(HealthCheck),
    )
