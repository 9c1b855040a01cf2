"""`python -m pat3d` is the `pat3d` command."""

import sys

from pat3d.cli.main import main

sys.exit(main())
