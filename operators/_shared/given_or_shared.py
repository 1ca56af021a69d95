# SPDX-License-Identifier: GPL-3.0-or-later
"""Properties that an operator has in common with the scene."""

from typing import Any


def given_or_shared(operator: Any, shared: Any, declared: type) -> dict[str, Any]:
    """Return all declared properties by name: as given to the operator, else as the scene has them.

    `shared`: property group of the scene. `declared`: class that declares the properties of both.
    """
    given = operator.properties.is_property_set
    return {
        name: getattr(operator if given(name) else shared, name)
        for name in declared.__annotations__
    }
