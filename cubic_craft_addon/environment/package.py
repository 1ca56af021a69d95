# SPDX-License-Identifier: GPL-3.0-or-later
"""The name under which Blender has loaded the extension."""

ROOT_PACKAGE = __name__.partition(".cubic_craft_addon.")[0]
