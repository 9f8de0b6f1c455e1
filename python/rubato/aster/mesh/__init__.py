# SPDX-License-Identifier: LGPL-3.0-or-later
"""What commands do with meshes: taken apart and built again, turned, read from files of other programs."""
