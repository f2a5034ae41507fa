"""The app itself, off screen on 1280 x 800, with a robot side in a process of its own.

The first frame counts from just before the process is made. "Live" counts from Connect until every widget of the drive
screen shows something fresh and the first picture is there. The main thread's share is its own CPU time
(`time.thread_time` in the UI thread) over 15 s with all streams of the drive screen; what the software GL's thread
spends on pixels, which a GPU does on a device, is not in it and is given as the process's share. Frames are those drawn,
not the turns of the loop; what of them is shaded more than once, or for nothing, is counted by OpenGL. Memory is the resident
set after that; with the drawing left out it is without the buffers and compiled shaders of the software GL, which has
every call swallowed. The other way is a Kivy app with one button, whose first frame is also what "live" is held against.
The main thread's share is held against a core that draws that app's first frame after 0.29 s: on a core half as fast its
other value is twice as high.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from bench.support.figures import Figure
from bench.support.harness import Context, Sides
from bench.support.pair import SETTLING, app, pair

BARE = "Kivy with one button"
BARE_START = "first frame of Kivy with one button"
CORE = "a core that starts one button in 0.29 s"
CORE_START = 0.29
"""First frame of one button on the core that the main thread's share is of [s]."""
FIGURES = (
    Figure("first_frame", "s", "process start to first frame", target=2, against=BARE, share=1.6),
    Figure("live", "s", "Connect to every widget live", target=2, against=BARE_START, share=2.5),
    Figure("main_thread", "% of a core", "main thread, drive screen live", against=CORE, share=0.15),
    Figure("process", "% of a core", "the whole process, software GL included"),
    Figure("frames", "1/s", "frames drawn meanwhile", better="more"),
    Figure("overdraw", "×", "pixels shaded for a frame, of those of the glass", target=2.2),
    Figure("memory", "MB", "resident, drive screen live, software GL included", against=BARE),
    Figure("own_memory", "MB", "the same with the drawing left out", against=BARE, share=1.2),
)
REPEATS = 3
WATCHED = 15.0
"""[s]"""


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Nothing is kept."""
    yield Sides(ours, bare)


def ours() -> dict[str, float]:
    """One sample of every figure; RuntimeError when a widget stays dark."""
    own = own_memory()
    with pair() as both:
        connected = both.ask("connect", url=both.url)
        if connected["waiting"]:
            raise RuntimeError(
                f"Not live after {connected['live']:.0f} s: {', '.join(connected['waiting'])}."
            )
        both.ask("watch", seconds=SETTLING)
        seen = both.ask("watch", seconds=WATCHED)
        return {
            "first_frame": both.started["first_frame"],
            "live": connected["live"],
            "main_thread": seen["main"] * 100,
            "process": seen["process"] * 100,
            "frames": seen["frames"],
            "overdraw": both.ask("overdraw")["times"],
            "memory": seen["rss"] / 1e6,
            "own_memory": own,
        }


def own_memory() -> float:
    """Of the app without software GL [MB]."""
    with pair("--no-gl") as both:
        both.ask("connect", url=both.url)
        return both.ask("watch", seconds=SETTLING)["rss"] / 1e6


def bare() -> dict[str, float]:
    """What Kivy alone takes."""
    with app("--bare") as (_, started):
        first, memory = started["first_frame"], started["rss"] / 1e6
    core = 100 * first / CORE_START
    return {"first_frame": first, "live": first, "main_thread": core, "memory": memory, "own_memory": memory}
