"""`python -m litz` is the command `litz`."""

import sys

from .cli import main

sys.exit(main())
