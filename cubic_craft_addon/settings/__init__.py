# SPDX-License-Identifier: GPL-3.0-or-later
"""What the artist chooses: declared, stored on objects, and read as plain values.

``properties`` declares it, ``values`` is what a run gets to see, ``overrides`` is what holds for
several objects at once.
"""
