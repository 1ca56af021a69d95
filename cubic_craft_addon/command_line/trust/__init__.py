# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of strangers: what may be read and written for them, see docs/trust.md.

`before_reading` looks into a file before Blender does: `fbx`, `gltf`, `obj` and `usd` (with
`usd_crate`) find what it refers to. `trial` has Blender read it in another process first, which may
crash. `opened` decides what of a file that is open is refused or left out. `places` says what lies
outside of a folder, and `links` that nothing is written through a link.
"""
