# SPDX-License-Identifier: GPL-3.0-or-later
"""The status line below the buttons, and the details under it.

It is the header of a section, so that it is always present and nothing moves when it changes. It
shows the outcome of the last run, what has changed since, the progress of Live, or how to leave a
mode in which nothing can be done.
"""

import bpy

from ...solver.console.run_words import crossing_words
from .. import job, live, mesh_bridge
from ..environment.modes import is_mode_usable
from ..mesh_bridge import LastRun
from ..screen.text_fit import draw_wrapped, longest_that_fits, room_for_text
from . import buttons, edited

_SECTION = "CUBIC_CRAFT_PT_last_run"
_ARROW, _ICON = 1.0, 1.0  # widths in units of an icon
_COLUMN = 0.42  # of the width, for the labels


def draw(
    context: bpy.types.Context,
    layout: bpy.types.UILayout,
    obj: bpy.types.Object,
    run: LastRun | None,
    changes: list[str],
) -> None:
    """Draw the line and, if it is expanded, the details of the last run.

    `layout`: of the whole panel. `obj`: the object with the mesh. `run`: LastRun or None, the run
    that made the shape of the mesh. `changes`: labels of the settings that have changed since.
    """
    header, body = layout.panel(_SECTION, default_closed=True)
    _draw_line(context, header, obj, run, changes)
    if body is not None:
        _draw_numbers(context, body, run, changes)


def _draw_line(context, layout, obj, run, changes):
    session, running = live.current(), job.current()
    room = room_for_text(context, _ARROW)
    if running is not None:
        buttons.draw_progress(layout, running, lambda texts: longest_that_fits(texts, room - _ICON))
        return
    if session is not None:
        mesh = session.mesh_of(obj)
        if mesh is None:
            layout.label(text=longest_that_fits(("Another mesh is live", "Not live"), room))
        else:
            texts, progress = mesh.run.status
            layout.progress(text=longest_that_fits(texts, room), factor=progress)
        return
    room -= _ICON * _ARROW
    if not is_mode_usable(context):
        text = longest_that_fits(("Switch to Object Mode", "Object Mode"), room)
        layout.operator("object.mode_set", text=text, icon="OBJECT_DATAMODE").mode = "OBJECT"
        return
    texts, icon = _words(run, changes, is_edited=edited.is_edited(mesh_bridge.mesh_of(obj)))
    layout.alert = icon == "ERROR"
    layout.active = run is not None
    layout.label(text=longest_that_fits(texts, room), icon=icon)


def _words(run, changes, *, is_edited):
    if run is None:
        return ("Not cubified yet", "Not cubified"), "BLANK1"
    if changes:
        count = f"{len(changes)} settings changed" if len(changes) > 1 else "1 setting changed"
        return (f"Changed: {', '.join(changes)}", count, "Changed"), "INFO"
    if is_edited:
        return ("Edited since the last run", "Edited since", "Edited"), "INFO"
    if not run.converged:
        iterations = f"{run.iterations} iterations"
        return (f"Not converged after {iterations}", f"Not converged: {iterations}"), "ERROR"
    crossing, is_failed = crossing_words(run.crossings, run.pressed)
    if crossing:
        short = crossing.replace(" still", "").split(":")[0]
        texts = f"{crossing}, leave more room", crossing, short
        return texts, "ERROR" if is_failed else "INFO"
    seconds = f"{run.seconds:.2f} s"
    return (
        f"Converged in {seconds}, {_vertices(run)}",
        f"Converged in {seconds}",
        "Converged",
    ), "CHECKMARK"


def _draw_numbers(context, layout, run, changes):
    column = layout.column(align=True)
    column.active = run is not None
    for name, value in _NUMBERS:
        split = column.split(factor=_COLUMN)
        title = split.row()
        title.alignment = "RIGHT"
        title.label(text=name)
        split.label(text=value(run) if run else "-")
    if run is not None and changes:
        draw_wrapped(context, column, f"Changed since: {', '.join(changes)}", taken=0.0)


def _vertices(run, unit=" vertices"):
    of_what = f" of {run.objects} objects" if run.objects > 1 else ""
    return f"{run.vertices:,}{unit}{of_what}"


def _crossing(run):
    if run.crossings is None:
        return "-"
    return f"{run.crossings:,} faces" if run.crossings else "none"


def _symmetry(run):
    return "-" if run.matching is None else f"{run.matching:,} of {run.own_vertices:,} match"


_NUMBERS = (
    ("Cubeness", lambda run: f"{run.settings.get('cubeness', 0.0):.3g}"),
    ("Vertices", lambda run: _vertices(run, "")),
    ("Iterations", lambda run: f"{run.iterations:,}"),
    ("Symmetry", _symmetry),
    ("Crossing", _crossing),
    ("Energy", lambda run: f"{run.energy:.5f}"),
    ("Time", lambda run: f"{run.seconds:.2f} s"),
    ("Device", lambda run: run.device),
)
