# SPDX-License-Identifier: GPL-3.0-or-later
"""What is on the screen: the window, its areas and regions, and the buttons in them."""

import dataclasses
import os
import shutil
import subprocess

import bpy


def window():
    """Return Blender's main window (bpy.context.window may be None in a timer)."""
    return bpy.context.window_manager.windows[0]


def x_window():
    """Return the X server's id of Blender's window; "" without X server or without xdotool."""
    if not shutil.which("xdotool"):
        return ""
    command = ["xdotool", "search", "--onlyvisible", "--pid", str(os.getpid())]
    found = subprocess.run(command, check=False, capture_output=True, text=True)
    return found.stdout.split()[0] if found.stdout else ""


def area(area_type="VIEW_3D"):
    """Return the first area of this type, by default the viewport."""
    return _first_of_type(window().screen.areas, area_type)


def region(region_type="WINDOW", area_type="VIEW_3D"):
    """Return a region of an area: WINDOW (the view itself), UI (the sidebar), HEADER, ..."""
    return _first_of_type(area(area_type).regions, region_type)


def _first_of_type(items, wanted):
    for item in items:
        if item.type == wanted:
            return item
    raise LookupError(f"no {wanted} on the screen")


def in_region(region_type="WINDOW", area_type="VIEW_3D"):
    """Return a context manager in which operators find this window, area and region."""
    return bpy.context.temp_override(
        window=window(), area=area(area_type), region=region(region_type, area_type)
    )


def running_operators():
    """Return the class names of the modal operators that run, such as ["MY_EXTENSION_OT_run"]."""
    return [operator.bl_idname for operator in window().modal_operators]


def viewport_point(across=0.4, up=0.5):
    """Return a point over the viewport, given as fractions of its width and height."""
    view = region()
    return view.x + int(across * view.width), view.y + int(up * view.height)


def simplify_viewport():
    """Make redraws cheaper still: no overlays, no gizmos, no outlines."""
    space = area().spaces.active
    space.overlay.show_overlays = False
    space.show_gizmo = False
    space.shading.show_object_outline = False


def smooth_viewport(is_smooth=True):
    """Draw surfaces and lines with smooth edges, or, as all tests begin, without.

    On the processor, each is a pass over all pixels, and makes a redraw half as long again.
    """
    system = bpy.context.preferences.system
    system.viewport_aa = "5" if is_smooth else "OFF"
    system.use_overlay_smooth_wire = is_smooth


@dataclasses.dataclass(frozen=True)
class Button:
    """A button, slider, check box or field on the screen."""

    text: str  # what Blender calls it: an operator call or the full data path of a property
    left: int
    bottom: int
    right: int
    top: int
    target: str = ""  # what find_button was asked for; "": the mouse need not find it here
    region_type: str = "UI"
    area_type: str = "VIEW_3D"

    def at(self, across=0.5):
        """Return a point in the middle of its height, at this fraction of its width."""
        return round(self.left + across * (self.right - self.left)), (self.bottom + self.top) // 2

    def has(self, x, y):
        """Return whether a point is on it."""
        return self.left <= x <= self.right and self.bottom <= y <= self.top
