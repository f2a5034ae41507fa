"""Train the camera's detector: `python -m scripts.train_detector draw DIR`, then `… learn DIR OUT [--steps N] [--go-on]`.

`draw` makes pictures with their truth in worlds that are made up (seeds 1, 2, …; `bench/detector.py` judges by others), `learn` trains the
network of `robotside/perception/network.py` on them and writes OUT, weights in half precision for `robotside/perception/detector.npz`.
It needs `pip install jax`, which nothing else of Pilothouse does. A step is 16 pictures, half a second of one core.
"""

from __future__ import annotations

import argparse
import io
import pickle
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from bench.support.sights import Scene, scenes
from robotside.perception.network import CELL, LAYERS, wired
from robotside.perception.thing_detector import CLASSES, SEARCHED

WIDE, HIGH = SEARCHED
COLUMNS, ROWS = WIDE // CELL, HIGH // CELL
EACH = 16
"""Views of one furnishing of a world, and pictures of one step."""
MIN_SEEN, MIN_PIXELS, MAX_DISTANCE = 0.45, 80.0, 11.5
"""What is hidden more, smaller or farther is neither to be found nor to be left alone; a little beyond what the bench counts."""
BARELY_SEEN = 0.08
"""Part of a thing that is seen less than this is no part of the picture."""
WARM_UP = 60
"""Steps until the full rate of learning."""
RATE, WEIGHT_DECAY = 2.2e-3, 1e-2
MOMENTUM, SPREAD = 0.9, 0.99
FORGETTING = 0.97
"""Of the means and variances that the finished network uses, a step."""
NORM = 1e-3
"""Added to a variance."""
ZOOMED, ZOOMS = 0.6, (0.8, 1.4)
"""Part of the pictures that are made larger or smaller while it learns, and by how much at most."""
NOISY = 0.25
"""Part of them that get noise of up to 6 steps of brightness."""
CLASS_FOCUS = 2
"""Exponent by which what is easy counts less."""


def draw(folder: Path, seed: int, count: int) -> None:
    """Write `count` pictures of this seed with their truth."""
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(seed)
    pictures, truths = [], []
    for number, scene in enumerate(scenes(seed, count, judging=False, each=EACH, labels=SEARCHED)):
        pictures.append(_searched(scene, int(rng.integers(65, 90))))
        truths += [
            (number, CLASSES.index(truth.kind), *truth.box, truth.pixels, truth.seen, truth.distance)
            for truth in scene.truths
        ]
        if number % 100 == 99:
            print(f"{number + 1} of {count}", flush=True)
    np.savez(folder / f"{seed}.npz", pictures=np.stack(pictures), truths=np.array(truths, np.float32))


def _searched(scene: Scene, quality: int) -> np.ndarray:
    """The picture as the detector sees it, with what a JPEG file loses."""
    file = io.BytesIO()
    Image.fromarray(scene.picture).save(file, "JPEG", quality=quality)
    image = Image.open(file)
    image.draft("RGB", SEARCHED)
    return np.asarray(image.convert("RGB"))


def targets(count: int, truths: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """For each cell of each picture: its class or -1, whether it is not judged, and how far its thing's edges are [px].

    The cells round the middle of a thing are its own; where things overlap, of the smaller one.
    """
    kinds = np.full((count, ROWS, COLUMNS), -1, np.int8)
    unjudged = np.zeros((count, ROWS, COLUMNS), np.bool_)
    reach = np.ones((count, ROWS, COLUMNS, 4), np.float32)
    area = np.full((count, ROWS, COLUMNS), np.inf, np.float32)
    x, y = (np.arange(COLUMNS) + 0.5) * CELL, (np.arange(ROWS) + 0.5) * CELL
    for number, kind, left, top, right, low, pixels, seen, distance in truths:
        at = int(number)
        box = left * WIDE, top * HIGH, right * WIDE, low * HIGH
        columns = np.flatnonzero(
            np.abs(x - (box[0] + box[2]) / 2) <= np.clip(0.2 * (box[2] - box[0]), 4.2, 16)
        )
        rows = np.flatnonzero(np.abs(y - (box[1] + box[3]) / 2) <= np.clip(0.2 * (box[3] - box[1]), 4.2, 16))
        if not (seen >= MIN_SEEN and pixels >= MIN_PIXELS and distance < MAX_DISTANCE):
            unjudged[at][np.ix_(rows, columns)] |= seen > BARELY_SEEN
            continue
        size = (box[2] - box[0]) * (box[3] - box[1])
        for row in rows:
            for column in columns:
                if size < area[at, row, column]:
                    area[at, row, column], kinds[at, row, column] = size, kind
                    edges = x[column] - box[0], y[row] - box[1], box[2] - x[column], box[3] - y[row]
                    reach[at, row, column] = np.maximum(edges, 1.0)
    return kinds, unjudged & (kinds < 0), reach


def fresh(seed: int = 0) -> tuple[dict[str, Any], dict[str, Any]]:
    """Layers as they are before anything was learnt, and the means and variances of what they give."""
    rng = np.random.default_rng(seed)
    layers, norms = {}, {}
    for name, (edge, taken, made) in LAYERS.items():
        spread = np.sqrt(2 / (edge * edge * taken))
        weights = (rng.standard_normal((edge, edge, taken, made)) * spread).astype(np.float32)
        layers[name] = {"w": weights, "b": np.zeros(made, np.float32), "g": np.ones(made, np.float32)}
        norms[name] = (np.zeros(made, np.float32), np.ones(made, np.float32))
    head = layers["head"]
    head["w"] *= 0.1
    head["b"][: len(CLASSES)], head["b"][len(CLASSES) :] = -4.0, 1.0
    return layers, norms


def outputs(layers: Any, pictures: Any) -> tuple[Any, dict[str, Any]]:
    """What the network gives for each cell of the pictures while it learns, and each layer's mean and variance."""
    import jax
    from jax import numpy as jnp

    seen: dict[str, Any] = {}

    def convolve(name: str, array: Any, stride: int) -> Any:
        own = layers[name]
        if own["w"].shape[0] == 1:
            made = array @ own["w"][0, 0]
        else:
            made = jax.lax.conv_general_dilated(
                array, own["w"], (stride,) * 2, ((1, 1),) * 2, dimension_numbers=("NHWC", "HWIO", "NHWC")
            )
        if name == "head":
            return made + own["b"]
        mean, spread = made.mean((0, 1, 2)), made.var((0, 1, 2))
        seen[name] = (mean, spread)
        return jnp.maximum((made - mean) * jax.lax.rsqrt(spread + NORM) * own["g"] + own["b"], 0)

    def twice(small: Any, large: Any) -> Any:
        return jnp.repeat(jnp.repeat(small, 2, 1), 2, 2)[:, : large.shape[1], : large.shape[2]]

    plain = pictures - pictures.mean((1, 2, 3), keepdims=True)
    plain /= jnp.maximum(plain.std((1, 2, 3), keepdims=True), 1.0)
    count = len(pictures)
    folded = plain.reshape(count, HIGH // 2, 2, WIDE // 2, 2, 3).transpose(0, 1, 3, 2, 4, 5)
    return wired(folded.reshape(count, HIGH // 2, WIDE // 2, 12), convolve, twice), seen


def loss(layers: Any, pictures: Any, kinds: Any, unjudged: Any, reach: Any) -> tuple[Any, Any]:
    """How wrong the network is: focal loss of the classes and generalised overlap of the boxes."""
    import jax
    from jax import numpy as jnp

    given, seen = outputs(layers, pictures)
    odds, edges = given[..., : len(CLASSES)], jnp.exp(jnp.clip(given[..., len(CLASSES) :], -4, 5)) * CELL
    wanted = (kinds[..., None] == jnp.arange(len(CLASSES))).astype(jnp.float32)
    right = jax.nn.sigmoid(jnp.where(wanted > 0, odds, -odds))
    weight = (1 - right) ** CLASS_FOCUS * (wanted * 0.35 + (1 - wanted) * 0.65)
    entropy = -jax.nn.log_sigmoid(jnp.where(wanted > 0, odds, -odds)) * weight
    entropy *= (1 - unjudged.astype(jnp.float32))[..., None]
    own = (kinds >= 0).astype(jnp.float32)
    count = jnp.maximum(own.sum(), 1)

    def area(four: Any) -> Any:
        return (four[..., 0] + four[..., 2]) * (four[..., 1] + four[..., 3])

    shared, round_ = area(jnp.minimum(edges, reach)), area(jnp.maximum(edges, reach))
    both = area(edges) + area(reach) - shared
    overlap = shared / both - (round_ - both) / round_
    return 2 * entropy.sum() / count + ((1 - overlap) * own).sum() / count, seen


def learn(folder: Path, out: Path, steps: int, *, go_on: bool) -> None:
    """Train for so many steps; `go_on` begins with what an earlier run has left beside `out`."""
    import jax
    from jax import numpy as jnp

    pictures, rows = _read(folder)
    left = out.with_suffix(".pickle")
    layers, norms = pickle.loads(left.read_bytes()) if go_on else fresh()  # noqa: S301 - our own file
    layers = jax.tree.map(jnp.asarray, layers)
    first, second = (jax.tree.map(jnp.zeros_like, layers) for _ in range(2))

    @jax.jit
    def step(layers: Any, first: Any, second: Any, batch: Any, rate: Any, number: Any) -> Any:
        (wrong, seen), slope = jax.value_and_grad(loss, has_aux=True)(layers, *batch)
        steep = jnp.sqrt(sum((part**2).sum() for part in jax.tree.leaves(slope)))
        slope = jax.tree.map(lambda part: part * jnp.minimum(1, 10 / steep), slope)
        first = jax.tree.map(lambda old, new: MOMENTUM * old + (1 - MOMENTUM) * new, first, slope)
        second = jax.tree.map(lambda old, new: SPREAD * old + (1 - SPREAD) * new * new, second, slope)

        def moved(path: Any, old: Any, mean: Any, square: Any) -> Any:
            way = mean / (1 - MOMENTUM**number) / (jnp.sqrt(square / (1 - SPREAD**number)) + 1e-8)
            return old - rate * (way + (WEIGHT_DECAY * old if path[-1].key == "w" else 0.0))

        return jax.tree_util.tree_map_with_path(moved, layers, first, second), first, second, wrong, seen

    rng = np.random.default_rng(1)
    for number in range(1, steps + 1):
        batch = _batch(rng, pictures, rows)
        rate = RATE * min(1.0, number / WARM_UP) * (0.5 + 0.5 * np.cos(np.pi * number / steps)) + 1e-5
        layers, first, second, wrong, seen = step(layers, first, second, batch, rate, float(number))
        for name, fresh_ in seen.items():
            norms[name] = tuple(
                FORGETTING * np.asarray(old) + (1 - FORGETTING) * np.asarray(new)
                for old, new in zip(norms[name], fresh_, strict=True)
            )
        if number % 50 == 0:
            print(f"{number} of {steps}: {float(wrong):.3f}", flush=True)
    left.write_bytes(pickle.dumps((jax.tree.map(np.asarray, layers), norms)))
    np.savez(out, **finished(layers, norms))


def _read(folder: Path) -> tuple[np.ndarray, list[np.ndarray]]:
    """The pictures, and of each the rows of its truth."""
    files = [np.load(path) for path in sorted(folder.glob("*.npz"))]
    rows = [
        file["truths"][file["truths"][:, 0] == number]
        for file in files
        for number in range(len(file["pictures"]))
    ]
    return np.concatenate([file["pictures"] for file in files]), rows


def _batch(rng: np.random.Generator, pictures: np.ndarray, rows: list[np.ndarray]) -> tuple[Any, ...]:
    """Some pictures, most of them nearer or farther, half mirrored, a quarter with noise, each in a light of its own."""
    chosen = rng.choice(len(pictures), EACH, replace=False)
    looks = [_nearer(rng, pictures[number], rows[number]) for number in chosen]
    seen = np.stack([picture for picture, _ in looks]).astype(np.float32)
    for at, (_, truths) in enumerate(looks):
        truths[:, 0] = at
    kinds, unjudged, reach = targets(EACH, np.concatenate([truths for _, truths in looks]))
    mirrored = np.flatnonzero(rng.random(EACH) < 0.5)
    seen[mirrored], kinds[mirrored] = seen[mirrored][:, :, ::-1], kinds[mirrored][:, :, ::-1]
    unjudged[mirrored] = unjudged[mirrored][:, :, ::-1]
    reach[mirrored] = reach[mirrored][:, :, ::-1][..., [2, 1, 0, 3]]
    seen *= rng.uniform(0.85, 1.15, (EACH, 1, 1, 3)).astype(np.float32)
    for at in np.flatnonzero(rng.random(EACH) < NOISY):
        seen[at] += rng.standard_normal(seen[at].shape, dtype=np.float32) * rng.uniform(1.0, 6.0)
    return seen, kinds, unjudged, reach


def _nearer(rng: np.random.Generator, picture: np.ndarray, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A part of the picture enlarged, or the picture smaller within its mean colour, with the truth of that."""
    rows = rows.copy()
    if rng.random() > ZOOMED:
        return picture, rows
    zoom = float(np.exp(rng.uniform(*np.log(ZOOMS))))
    size = np.array((WIDE, HIGH))
    spare = size - size / zoom
    corner = rng.uniform(np.minimum(spare, 0), np.maximum(spare, 0))
    small = Image.fromarray(picture).transform(
        (WIDE, HIGH),
        Image.Transform.AFFINE,
        (1 / zoom, 0, corner[0], 0, 1 / zoom, corner[1]),
        resample=Image.Resampling.BILINEAR if zoom > 1 else Image.Resampling.BICUBIC,
        fillcolor=tuple(int(part) for part in picture.mean((0, 1))),
    )
    whole = (rows[:, 2:6] - np.tile(corner / size, 2)) * zoom
    rows[:, 2:6] = np.clip(whole, 0, 1)
    edges = rows[:, 4:6] - rows[:, 2:4]
    part = edges.prod(1) / (whole[:, 2:4] - whole[:, :2]).prod(1)
    rows[:, 6] *= zoom * zoom * part
    rows[:, 7] *= part
    rows[:, 8] /= zoom
    return np.asarray(small), rows[(edges > 0).all(1)]


def finished(layers: Any, norms: Any) -> dict[str, np.ndarray]:
    """The layers with their norms folded into them, as the robot reads them."""
    made: dict[str, np.ndarray] = {}
    for name in LAYERS:
        own = {key: np.asarray(part) for key, part in layers[name].items()}
        weights, added = own["w"], own["b"]
        if name != "head":
            mean, spread = (np.asarray(part) for part in norms[name])
            scale = own["g"] / np.sqrt(spread + NORM)
            weights, added = weights * scale, added - mean * scale
        made[f"{name}.w"], made[f"{name}.b"] = weights.astype(np.float16), added.astype(np.float32)
    return made


def main() -> None:
    """Draw or learn, as the command line says."""
    parser = argparse.ArgumentParser(prog="python -m scripts.train_detector", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    drawing = commands.add_parser("draw", help="make pictures with their truth")
    drawing.add_argument("folder", type=Path)
    drawing.add_argument("--seed", type=int, default=1)
    drawing.add_argument("--count", type=int, default=1600)
    learning = commands.add_parser("learn", help="train the network on them")
    learning.add_argument("folder", type=Path)
    learning.add_argument("out", type=Path)
    learning.add_argument("--steps", type=int, default=1600)
    learning.add_argument("--go-on", action="store_true")
    asked = parser.parse_args()
    if asked.command == "draw":
        draw(asked.folder, asked.seed, asked.count)
    else:
        learn(asked.folder, asked.out, asked.steps, go_on=asked.go_on)


if __name__ == "__main__":
    main()
