"""Imports in a process of its own, `python -m bench.support.importing kivy|app|robot`, and says what that took.

`kivy` is Kivy with its window, off screen; `app` is what the handheld imports before its first frame, and `robot` what it
imports for a robot besides. A line of JSON gives the processor time [s] since the process began, and how many modules
there are.
"""

from __future__ import annotations

import json
import os
import sys
import time


def main(what: str) -> None:
    """Import it, and print the line."""
    os.environ.pop("DISPLAY", None)
    os.environ.update(SDL_VIDEODRIVER="offscreen", KIVY_NO_CONSOLELOG="1", KIVY_NO_ENV_CONFIG="1")
    os.environ.update(KIVY_NO_ARGS="1", KIVY_NO_FILELOG="1")
    if what == "kivy":
        import kivy.app
        import kivy.core.window
        import kivy.uix.button  # noqa: F401 - as the app with one button
    else:
        from app.__main__ import prepare

        prepare()
        import app.application  # noqa: F401
    if what == "robot":
        from app.idle_work import METHODS, SOON, imports

        for step in imports([*METHODS, *SOON]):
            step()
    print(json.dumps({"cpu": time.process_time(), "modules": len(sys.modules)}), flush=True)


if __name__ == "__main__":
    main(sys.argv[1])
