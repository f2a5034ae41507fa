"""Five hundred drawn scenes with their truth, in five kinds of worlds: what the camera's detector finds, takes for something else, or makes up.

Worlds, colours and seeds are others than those that the detector learnt from: the car park, the office and the orchard of the simulator,
emptied and furnished anew, and made-up grounds indoors and outdoors. People stand, walk, wave, bend and crouch; cones have four liveries;
things stand 1.5 to 10 m away and hide each other. Four in ten scenes are at dusk: a quarter to half of the light, warm or blue, and noise.
A thing counts when half of it or more can be seen, with 100 pixels or more of 640 x 480; it is found when a box of its class shares half
of what both cover. What can be seen less counts neither way. The other way is the rule
of colours that the robot had alone before: orange, white, orange; the detector still asks it for cones that the network is not sure of.
"""

from __future__ import annotations

import io
import time
from collections import defaultdict
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from PIL import Image

from bench.support.confusion import Confusion
from bench.support.figures import Figure
from bench.support.harness import Context, Sides
from bench.support.sights import Scene, scenes
from robotside.perception.cone_detector import find_cones
from robotside.perception.intruder_tracker import SURE_SCORE
from robotside.perception.sighting import Sighting
from robotside.perception.thing_detector import CLASSES, find_things

RULE = "a rule of colours for cones"
SEED = 2026
QUALITY = 80
"""Of the JPEG files, as the simulator's camera makes them."""

FIGURES = (
    *(
        Figure(
            f"{light}{kind}_{share}",
            "",
            f"{kind}: {meaning}{' at dusk' if light else ''}",
            0.85 if light else 0.95,
            better="more",
            against=RULE,
        )
        for light in ("", "dusk_")
        for kind in CLASSES
        for share, meaning in (
            ("precision", "of what was told so is one"),
            ("recall", "of those to be found are told so"),
        )
    ),
    Figure(
        "worst_world",
        "",
        "least precision or recall of any class in any kind of world",
        better="more",
        against=RULE,
    ),
    Figure("things", "", "things to be found"),
    Figure("cpu", "ms", "CPU time for one picture", target=60.0, against=RULE),
)
REPEATS = 1

Finder = Callable[[bytes], list[Sighting]]


@contextmanager
def prepare(context: Context) -> Iterator[Sides]:
    """The scenes are drawn once, for both."""
    drawn = [
        (scene, _file(scene)) for scene in scenes(SEED, int(context.count("scenes")), judging=True, each=10)
    ]
    yield Sides(lambda: _judged(drawn, find_things), lambda: _judged(drawn, find_cones))


def _file(scene: Scene) -> bytes:
    file = io.BytesIO()
    Image.fromarray(scene.picture).save(file, "JPEG", quality=QUALITY)
    return file.getvalue()


def _judged(drawn: list[tuple[Scene, bytes]], find: Finder) -> dict[str, float]:
    by_light: dict[bool, Confusion] = {False: Confusion(), True: Confusion()}
    by_world: dict[str, Confusion] = defaultdict(Confusion)
    find(drawn[0][1])
    spent = 0.0
    for scene, file in drawn:
        begun = time.process_time()
        found = [each for each in find(file) if each.score >= SURE_SCORE]
        spent += time.process_time() - begun
        for confusion in (by_light[scene.dusk], by_world[scene.world]):
            confusion.add(scene.truths, found)
    for name, confusion in (("by day", by_light[False]), ("at dusk", by_light[True])):
        print(f"{find.__name__}, {name}:", *confusion.lines(CLASSES), sep="\n")
    worst = {name: confusion.worst(CLASSES) for name, confusion in by_world.items()}
    print("least of each world: " + ", ".join(f"{name} {least:.3f}" for name, least in worst.items()))
    figures: dict[str, float] = {}
    for dusk, confusion in by_light.items():
        for kind in CLASSES:
            share = confusion.share(kind)
            prefix = "dusk_" if dusk else ""
            figures |= {f"{prefix}{kind}_precision": share.precision, f"{prefix}{kind}_recall": share.recall}
    things = sum(
        count
        for (true, _), count in (by_light[False].table + by_light[True].table).items()
        if true in CLASSES
    )
    return figures | {
        "worst_world": min(worst.values()),
        "things": things,
        "cpu": spent / len(drawn) * 1e3,
    }
