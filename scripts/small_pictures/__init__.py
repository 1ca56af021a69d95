# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures in the panel, and on the extensions platform."""
