"""A large occupancy grid on the glass: 3200 x 1680 cells, as a building of 160 m x 84 m has at 5 cm.

Off screen by OpenGL in software, 1280 x 800. "On the glass" counts from the message's bytes as CBOR until the first frame that shows
all of the grid has been drawn and finished; beside it the CPU time that the UI thread itself spends meanwhile, and its longest frame,
in which a finger would find the app away. Another grid comes with each sample, so that nothing is kept.

The other way does all in the UI thread: it finds what is known, makes one RGBA picture by a table of colours, and has one texture.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from bench.support.child import child
from bench.support.figures import Figure
from bench.support.harness import Context, Sides

NAIVE = "one RGBA texture made in the UI thread"
FIGURES = (
    Figure("on_glass", "s", "bytes to the frame that shows it", 1.0, against=NAIVE),
    Figure("main_thread", "ms", "CPU time of the UI thread meanwhile", against=NAIVE),
    Figure("longest_frame", "ms", "longest frame meanwhile", against=NAIVE, share=1.0),
    Figure("memory", "MB", "bytes of its textures", against=NAIVE),
)
REPEATS = 3


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Nothing is kept."""
    yield Sides(lambda: _measured("ours"), lambda: _measured("naive"))


def _measured(way: str) -> Mapping[str, float]:
    with child("bench.support.map_costs", way) as process:
        found: Mapping[str, float] = process.receive()
    return found
