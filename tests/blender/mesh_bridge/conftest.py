# SPDX-License-Identifier: GPL-3.0-or-later
import importlib

import pytest
from results import write
from rich_mesh import add_rich_monkey, cubic_like


@pytest.fixture
def bridge(extension):
    return importlib.import_module(f"{extension.__name__}.cubic_craft_addon.mesh_bridge")


@pytest.fixture(autouse=True)
def no_healing(extension):
    """Keep the extension from ending previews by itself after undo and load."""
    healing = importlib.import_module(f"{extension.__name__}.cubic_craft_addon.live.stale_previews")
    healing.unregister()
    yield
    healing.register()


@pytest.fixture(autouse=True)
def no_memory(extension, monkeypatch):
    """Forget the previews that other tests have ended in Edit Mode, of the same shapes."""
    name = f"{extension.__name__}.cubic_craft_addon.mesh_bridge.preview.store"
    monkeypatch.setattr(importlib.import_module(name), "_ended_in_edit_mode", {})


@pytest.fixture
def error(extension):
    return importlib.import_module(f"{extension.__name__}.solver.errors").CubicCraftError


@pytest.fixture(params=[False, True], ids=["plain", "keys"])
def monkey(request):
    return add_rich_monkey(keys=request.param)


@pytest.fixture
def plain_monkey():
    return add_rich_monkey(keys=False)


@pytest.fixture
def keyed_monkey():
    return add_rich_monkey(keys=True)


@pytest.fixture
def cubify(bridge):
    """Return a function that gives an object a made-up result, and returns what has it."""

    def give(obj, result="MESH", seed=0, start="HERE"):
        made = cubic_like(bridge.original_positions(obj.data, start), seed)
        return write(bridge, obj, result, *made, start)

    return give
