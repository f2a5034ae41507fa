"""Where the phone and the desktop start the app."""

from __future__ import annotations

import sys

from app.__main__ import main

if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:  # Ctrl-C in the terminal it was started from is a way to close it
        sys.exit(0)
