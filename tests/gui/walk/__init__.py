# SPDX-License-Identifier: GPL-3.0-or-later
"""A random walk through Blender's window: what hands do to the extension when nobody has a plan.

What can happen next is listed in ``actions``; ``artist``, ``extension``, ``hands`` and ``files``
fill the list, and ``walk`` draws from it. ``meshes`` reads what must survive each step, and
``invariants`` sees that it has.
"""
