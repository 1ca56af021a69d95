# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture: the original beside its cubic versions, in a studio.

The command makes it for anybody's mesh. The scripts of this project that render the pictures of its
documentation share these modules.
"""
