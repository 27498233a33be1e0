"""`python -m edesign` is the command `edesign`."""

import sys

from edesign.cli.main import main

sys.exit(main())
