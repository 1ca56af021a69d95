# SPDX-License-Identifier: GPL-3.0-or-later
"""What we keep on a mesh: its original, what we wrote, and what has become of both since."""
