# SPDX-License-Identifier: GPL-3.0-or-later
"""Results for other programs: files for game engines and printers, and normal maps.

Nothing of the scene changes by writing a file. A normal map comes with a new object.
"""
