"""Lets ``python -m forgetting`` do what ``forgetting`` does."""

import sys

from forgetting.cli import main

if __name__ == "__main__":
    sys.exit(main())
