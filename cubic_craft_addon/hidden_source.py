# SPDX-License-Identifier: GPL-3.0-or-later
"""What a new object was made from, and takes the place of: hidden, and shown again by one click.

Both lie at the same place. The source is hidden in the view layers in which the new object is seen,
as by H, and in renders. Whether that was done here is noted on the source: what an artist has
hidden from renders stays so.
"""

import contextlib
from collections.abc import Callable, Iterator

import bpy
from bpy.props import BoolProperty, PointerProperty

from .environment.declared import added
from .mesh_bridge import after_errors

_SOURCE = "cubic_craft_stands_for"
_NOTE = "cubic_craft_hidden"


def hide(source: bpy.types.Object, new: bpy.types.Object) -> None:
    """Hide the source of a new object that is linked beside it.

    Not while it or the active object is in another mode than Object Mode: then it stays selected,
    as by `mesh_bridge.select_instead`.
    """
    new.property_unset(_NOTE)
    if _is_hidden_in_renders(source):
        new.hide_render = False  # a copy has this from its source
    active = bpy.context.view_layer.objects.active
    if source.mode != "OBJECT" or (active is not None and active.mode != "OBJECT"):
        return
    setattr(new, _SOURCE, source)
    if source.is_editable and not source.hide_render:
        source.hide_render = True
        setattr(source, _NOTE, True)
    for layer in _layers_of(new):
        _hide_in(layer, source, True)


def show(source: bpy.types.Object, new: bpy.types.Object) -> None:
    """Show a source where it was hidden behind the new object, which may be itself."""
    if _is_hidden_in_renders(source):
        source.hide_render = False
        source.property_unset(_NOTE)
    for layer in (bpy.context.view_layer, *_layers_of(new)):
        _hide_in(layer, source, False)
    if getattr(new, _SOURCE) == source:
        new.property_unset(_SOURCE)  # or copies of it in other files would bring it along


def as_it_was(source: bpy.types.Object) -> Callable[[], None]:
    """Return what undoes `hide`, and selects the source again if it is selected now."""
    is_noted, is_hidden_in_renders = getattr(source, _NOTE), source.hide_render
    layers = [(layer, source.hide_get(view_layer=layer)) for layer in _all_layers()]
    is_selected = source.select_get()

    def put_back():
        if not is_noted and getattr(source, _NOTE):
            source.hide_render = is_hidden_in_renders
            source.property_unset(_NOTE)
        for layer, is_hidden in layers:
            if source.hide_get(view_layer=layer) != is_hidden:
                _hide_in(layer, source, is_hidden)
        if is_selected:
            source.select_set(True)

    return put_back


def source_kept(source: bpy.types.Object | None) -> contextlib.AbstractContextManager[None]:
    """Show a source, if there is one, as it was before if the block raises."""
    return contextlib.nullcontext() if source is None else after_errors(as_it_was(source))


def hidden_source(obj: bpy.types.Object) -> bpy.types.Object | None:
    """Return the object that is hidden behind this one, or itself if it is hidden in renders only.

    The latter is left where the artist has removed the new object, and shown its source by Alt H.
    """
    source = getattr(obj, _SOURCE)
    if source is not None and (source.hide_get() or _is_hidden_in_renders(source)):
        return source
    return obj if _is_hidden_in_renders(obj) and not obj.hide_get() else None


def _is_hidden_in_renders(source):
    return getattr(source, _NOTE) and source.hide_render


def _hide_in(layer, source, is_hidden):
    with contextlib.suppress(RuntimeError):  # it is not in this one
        source.hide_set(is_hidden, view_layer=layer)


def _layers_of(new) -> Iterator[bpy.types.ViewLayer]:
    return (layer for layer in _all_layers() if new.visible_get(view_layer=layer))


def _all_layers() -> Iterator[bpy.types.ViewLayer]:
    return (layer for scene in bpy.data.scenes for layer in scene.view_layers)


_properties = {
    _SOURCE: PointerProperty(type=bpy.types.Object, options={"HIDDEN"}),
    _NOTE: BoolProperty(options={"HIDDEN"}),
}
register, unregister = added(bpy.types.Object, _properties)
