"""Lets ``python -m forgetting.cli`` do what ``forgetting`` does."""

import sys

from forgetting.cli import main

sys.exit(main())
