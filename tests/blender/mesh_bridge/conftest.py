# SPDX-License-Identifier: GPL-3.0-or-later
import importlib

import pytest
from rich_mesh import add_rich_monkey


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
    name = f"{extension.__name__}.cubic_craft_addon.mesh_bridge.preview.end"
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
def fail_once(bridge, monkeypatch):
    """Let one call of a function fail, as the second of ``"memory.original.write_note"``."""

    def fail(name, *, call):
        file, function = name.rsplit(".", 1)
        module = importlib.import_module(f"{bridge.__name__}.{file}")
        real = getattr(module, function)
        calls = []

        def failing(*args, **named):
            calls.append(args)
            if len(calls) == call:
                raise RuntimeError("disk on fire")
            return real(*args, **named)

        monkeypatch.setattr(module, function, failing)

    return fail
