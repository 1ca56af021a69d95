# SPDX-License-Identifier: GPL-3.0-or-later
"""A random walk through Blender's window: what hands do to the extension when nobody has a plan.

What can happen next is listed in ``actions``; ``artist``, ``extension``, ``hands`` and ``files``
fill the list. ``meshes`` reads what must survive, ``invariants`` checks that it has, ``walk`` walks.
"""
