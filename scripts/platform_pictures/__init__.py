# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures for the page of the extension on the extensions platform."""
