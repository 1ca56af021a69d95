# SPDX-License-Identifier: GPL-3.0-or-later
"""What must hold after each step, whatever it was."""

import collections
import logging
import re
import sys
import types

import bpy
import guidrive as gui
import live_scene as scene

from . import meshes
from .actions import is_cubifying, is_live, is_on

_ALWAYS = (
    ("undo_post", "_heal"),
    ("redo_post", "_heal"),
    ("load_post", "_keep"),
    ("load_post", "_start_anew"),
    ("depsgraph_update_post", "_follow_updates"),
    # what is kept between redraws
    *((name, "_on_update") for name in ("depsgraph_update_post", "frame_change_post")),
    *((name, "_on_other_data") for name in ("undo_post", "redo_post")),
    ("load_post", "_forget"),
)
_IN_LIVE = (
    *((name, "tell") for name in ("undo_post", "redo_post", "load_pre", "save_pre")),
    *((name, "tell") for name in ("save_post", "save_post_fail", "frame_change_post")),
    ("depsgraph_update_post", "_on_update"),
)
_IN_CUBIFY = (("undo_pre", "_on_undo"), ("redo_pre", "_on_undo"), ("load_pre", "_on_load"))
_MAKE_SEEN = ("cubify", "rest")
_REWRITE = ("cubify", "redo_panel", "restore", "start_or_confirm_live", "confirm_live", "rest")
_RESTORES_FIRST = re.compile(r"bpy\.ops\.cubic_craft\.restore_first\(")
_REWRITING_BUTTONS = re.compile(r"bpy\.ops\.cubic_craft\.(cubify|restore|live)\(")
_MENUS_OF_BRUSHES = re.compile(r"/bl_ui/(space_view3d|properties_paint_common)\.py$")


class _Errors(logging.Handler):
    """Keeps what the extension logs as an error: exceptions that it has caught."""

    def __init__(self):
        super().__init__(logging.ERROR)
        self.texts = []

    def emit(self, record):
        self.texts.append(self.format(record))


def _is_of_brushes(traceback):
    files = re.findall(r'^  File "(.+?)"', traceback, re.MULTILINE)
    return bool(files) and all(map(_MENUS_OF_BRUSHES.search, files))


class Invariants:
    """Compares the file and Blender after each step with what was there before it."""

    def __init__(self):
        self._errors = _Errors()
        logging.getLogger(scene.EXTENSION).addHandler(self._errors)
        self._functions = set()
        self._was_live = False
        self._before = meshes.read_all()
        self._shapes = {state.original for state in self._before.values()}
        self._faces = {state.faces for state in self._before.values()}

    def check(self, action, text):
        """Check everything after an action; AssertionError says what is wrong.

        `text` is what the action says of itself, the button that the mouse has pressed among it.
        """
        # Without the extension, too: Debian's 4.3 has no brushes, which Blender's menus of a right
        # click in Sculpt Mode and the paint modes take for granted.
        gui.python_errors[:] = [text for text in gui.python_errors if not _is_of_brushes(text)]
        assert not gui.python_errors, gui.python_errors[-1]
        assert not self._errors.texts, self._errors.texts[-1]
        self._check_handlers()
        self._check_timers()
        self._check_live()
        now = meshes.read_all()
        rewrites = action.name in _REWRITE or _REWRITING_BUTTONS.search(text) is not None
        rewrites |= self._was_live and not is_live()  # whatever has ended it confirms
        self._was_live = is_live()
        for uid, state in now.items():
            before = self._before.get(uid)
            is_first = before is not None and before.has_first and not state.has_traces
            if is_first and (action.name == "restore_first" or _RESTORES_FIRST.search(text)):
                self._shapes.add(state.original)  # which one, tests/blender knows
                before = None
            self._check_mesh(state, before, action, rewrites)
        self._before = now

    @property
    def states(self):
        """The meshes as of the last check, by `session_uid`."""
        return self._before

    def accept(self, uid):
        """Take the present shape of a mesh for one that it may have."""
        state = meshes.read_all()[uid]
        self._shapes |= {state.original, state.shape}

    def _check_mesh(self, state, before, action, rewrites):
        what = f"mesh {state.name!r} after {action.name}"
        assert state.is_finite, f"{what}: positions that are not finite"
        assert not (state.has_preview and is_on() and not is_live()), f"{what}: a preview is left"
        if action.reshapes:
            self._shapes.add(state.original)
            self._faces.add(state.faces)
            return
        if before is None and state.faces not in self._faces and action.name in _MAKE_SEEN:
            self._shapes.add(state.original)  # of what modifiers show, to a new object
            self._faces.add(state.faces)
        if before is not None and before.is_edited and rewrites:
            self._shapes.add(state.original)  # the original has gone along with the edit
            return
        assert state.faces in self._faces, f"{what}: other edges, faces or UVs"
        is_applied = before and state.original == before.shape and not state.has_traces
        if is_applied:
            self._shapes.add(state.original)
        assert state.original in self._shapes, f"{what}: the original is lost"
        if before and not action.goes_back:
            assert is_applied or state.original == before.original, f"{what}: another original"

    def _check_handlers(self):
        found = collections.Counter()
        for name in dir(bpy.app.handlers):
            handlers = getattr(bpy.app.handlers, name)
            if isinstance(handlers, list):
                ours = [h for h in handlers if h.__module__.startswith(scene.EXTENSION)]
                found.update((name, handler.__name__) for handler in ours)
        expected = collections.Counter(_ALWAYS if is_on() else ())
        expected.update(_IN_LIVE if is_live() else ())
        expected.update(_IN_CUBIFY if is_cubifying() else ())
        assert found == expected, f"handlers: {found - expected} more, {expected - found} missing"

    def _check_timers(self):
        for name, module in list(sys.modules.items()):
            if name.startswith(scene.EXTENSION):
                values = vars(module).values()
                self._functions.update(v for v in values if isinstance(v, types.FunctionType))
        left = [f for f in self._functions if bpy.app.timers.is_registered(f)]
        if is_on():  # the cube is shown for a moment after it was turned, and the engine is loaded
            left = [f for f in left if not f.__module__.endswith((".glimpse", ".ahead"))]
        assert not left, f"timers: {left}"

    def _check_live(self):
        is_modal = "CUBIC_CRAFT_OT_live" in gui.running_operators()
        assert is_modal == is_live(), f"Live runs: {is_live()}, its operator: {is_modal}"
        header = bpy.types.STATUSBAR_HT_header
        has_text = header.draw is not getattr(header, "_draw_orig", header.draw)
        is_busy = is_live() or is_cubifying()
        assert has_text == is_busy, f"Live or Cubify runs: {is_busy}, its status text: {has_text}"
        session = scene.live()._session if is_on() else None
        if session is not None and (session.is_ended or scene.is_idle()):
            assert session._timer is None, "Live is at rest with a timer"
