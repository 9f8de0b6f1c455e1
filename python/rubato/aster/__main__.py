# SPDX-License-Identifier: LGPL-3.0-or-later
"""python3 -m rubato.aster"""

import sys

from .command_line import main

sys.exit(main(sys.argv[1:]))
