# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension as a user has it, as for `tests/blender`."""

from installed import archive, empty_file, extension, pytest_sessionfinish, pytest_unconfigure

__all__ = ("archive", "empty_file", "extension", "pytest_sessionfinish", "pytest_unconfigure")
