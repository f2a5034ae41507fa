"""Train the camera's detector: `python -m scripts.train_detector draw DIR`, then `… learn DIR OUT [--steps N] [--begin WEIGHTS]`.

`draw` makes pictures with their truth in worlds that are made up (seeds 1, 2, …; `bench/detector.py` judges by others), `learn` trains the
network of `robotside/perception/network.py` on them and writes OUT, weights in half precision for `robotside/perception/detector.npz`.
It needs `pip install torch`, which nothing else of Pilothouse does. A step is 16 pictures, 0.35 s of one core that has bfloat16.
"""

from __future__ import annotations

import argparse
import io
import math
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from PIL import Image

from bench.support.sights import Scene, scenes
from robotside.perception.network import CELL, LAYERS, wired
from robotside.perception.thing_detector import CLASSES, SEARCHED

WIDE, HIGH = SEARCHED
COLUMNS, ROWS = WIDE // CELL, HIGH // CELL
VIEWS = 10
"""Of one furnishing of a world."""
EACH = 16
"""Pictures of one step."""
MIN_SEEN, MIN_PIXELS, MAX_DISTANCE = 0.45, 80.0, 11.5
"""What is hidden more, smaller or farther is neither to be found nor to be left alone; a little beyond what the bench counts."""
BARELY_SEEN = 0.02
"""Part of a thing that is seen less than this is no part of the picture."""
HALVING = ("stem", "to8", "to16", "to32", "to64")
"""Layers with a stride of two."""
WARM_UP, COOL_DOWN = 100, 1.0
"""Steps until the full rate of learning, and the part of all steps, the last one, in which it falls to nothing."""
RATE, WEIGHT_DECAY = 1.5e-3, 2e-2
SPREAD = 0.99
"""Of the squares of slopes, a step."""
MEAN = 0.998
"""Of the weights, a step: their moving mean is what is kept."""
ZOOMED, ZOOMS = 0.6, (0.75, 1.5)
"""Part of the pictures that are made larger or smaller while it learns, and by how much at most."""
NOISY = 0.3
"""Part of them that get noise of up to 6 steps of brightness."""
SWAPPED = 0.15
"""Part of them whose red, green and blue change places."""
CLASS_FOCUS = 2
"""Exponent by which what is easy counts less."""
AT_FIRST = 0.1
"""How loud a layer begins that the weights to begin with do not have."""
TOLD = 100
"""Steps between two lines of progress."""
KEPT = 500
"""Steps between two times that the weights are written."""


class Drawn(NamedTuple):
    """Pictures as JPEG files, and of each the rows of its truth."""

    files: list[bytes]
    rows: list[np.ndarray]


def draw(folder: Path, seed: int, count: int) -> None:
    """Write `count` pictures of this seed with their truth."""
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(seed)
    files, truths = [], []
    for number, scene in enumerate(scenes(seed, count, judging=False, each=VIEWS, labels=SEARCHED)):
        files.append(_file(scene, int(rng.integers(65, 90))))
        truths += [
            (number, CLASSES.index(truth.kind), *truth.box, truth.pixels, truth.seen, truth.distance)
            for truth in scene.truths
        ]
        if number % 100 == 99:
            print(f"{number + 1} of {count}", flush=True)
    np.savez(
        folder / f"{seed}.npz",
        files=np.frombuffer(b"".join(files), np.uint8),
        ends=np.cumsum([len(file) for file in files]),
        truths=np.array(truths, np.float32),
    )


def _file(scene: Scene, quality: int) -> bytes:
    file = io.BytesIO()
    Image.fromarray(scene.picture).save(file, "JPEG", quality=quality)
    return file.getvalue()


def read(folder: Path) -> Drawn:
    """All that was drawn into a folder."""
    drawn = Drawn([], [])
    for path in sorted(folder.glob("*.npz")):
        with np.load(path) as file:
            whole, ends, truths = file["files"].tobytes(), file["ends"], file["truths"]
        for number, (begin, end) in enumerate(zip([0, *ends[:-1]], ends, strict=True)):
            drawn.files.append(whole[begin:end])
            drawn.rows.append(truths[truths[:, 0] == number])
    return drawn


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
        cells = np.ix_(rows, columns)
        if not (seen >= MIN_SEEN and pixels >= MIN_PIXELS and distance < MAX_DISTANCE):
            unjudged[at][cells] |= seen > BARELY_SEEN
            continue
        size = (box[2] - box[0]) * (box[3] - box[1])
        smaller = size < area[at][cells]
        area[at][cells] = np.where(smaller, size, area[at][cells])
        kinds[at][cells] = np.where(smaller, kind, kinds[at][cells])
        across, down = np.meshgrid(x[columns], y[rows])
        edges = np.stack((across - box[0], down - box[1], box[2] - across, box[3] - down), axis=2)
        reach[at][cells] = np.where(smaller[..., None], np.maximum(edges, 1.0), reach[at][cells])
    return kinds, unjudged & (kinds < 0), reach


def network() -> Any:
    """The network as torch trains it: each layer with a norm of what it gives, but for the last one."""
    import torch

    made = torch.nn.ModuleDict()
    for name, (edge, taken, given) in LAYERS.items():
        stride = 2 if name in HALVING else 1
        conv = torch.nn.Conv2d(taken, given, edge, stride, edge // 2, bias=name == "head")
        made[name] = torch.nn.ModuleDict({"conv": conv})
        if name != "head":
            torch.nn.init.kaiming_normal_(conv.weight, nonlinearity="relu")
            made[name]["norm"] = torch.nn.BatchNorm2d(given, momentum=0.03)
    head = made["head"]["conv"]
    with torch.no_grad():
        head.weight *= 0.1
        head.bias[: len(CLASSES)], head.bias[len(CLASSES) :] = -4.0, 1.0
    return made.to(memory_format=torch.channels_last)


def outputs(layers: Any, pictures: Any, weights: Any = None) -> Any:
    """What the network gives for each cell of the pictures (number, 3, rows, columns): (number, rows, columns, outputs).

    With `weights`, of the file of a network that was trained before, the layers take them and give the same as that network.
    """
    import torch
    from torch.nn import functional

    def convolve(name: str, array: Any, _stride: int) -> Any:
        own = layers[name]
        if weights is not None:
            _take(own, name, array, weights)
        made = own["conv"](array)
        return made if name == "head" else functional.relu(own["norm"](made))

    def twice(small: Any, large: Any) -> Any:
        return functional.interpolate(small, scale_factor=2)[:, :, : large.shape[2], : large.shape[3]]

    plain = pictures - pictures.mean((1, 2, 3), keepdim=True)
    plain = plain / plain.std((1, 2, 3), keepdim=True).clamp(min=1.0)
    folded = plain.reshape(len(plain), 3, HIGH // 2, 2, WIDE // 2, 2).permute(0, 3, 5, 1, 2, 4)
    folded = folded.reshape(len(plain), 12, HIGH // 2, WIDE // 2)
    return wired(folded.contiguous(memory_format=torch.channels_last), convolve, twice).permute(0, 2, 3, 1)


def _take(own: Any, name: str, array: Any, weights: Any) -> None:
    """Give a layer the weights of that name, and its norm what undoes its norming of what these give."""
    import torch

    with torch.no_grad():
        if f"{name}.w" not in weights:
            own["norm"].weight.fill_(AT_FIRST)
            return
        kernel = weights[f"{name}.w"].astype(np.float32).transpose(3, 2, 0, 1)
        own["conv"].weight.copy_(torch.from_numpy(np.ascontiguousarray(kernel)))
        added = torch.from_numpy(weights[f"{name}.b"].astype(np.float32))
        if name == "head":
            own["conv"].bias.copy_(added)
            return
        made = own["conv"](array)
        mean, spread = made.mean((0, 2, 3)), made.var((0, 2, 3))
        norm = own["norm"]
        norm.running_mean.copy_(mean), norm.running_var.copy_(spread)
        norm.weight.copy_(torch.sqrt(spread + norm.eps)), norm.bias.copy_(mean + added)


def loss(given: Any, kinds: Any, unjudged: Any, reach: Any) -> Any:
    """How wrong the network is: focal loss of the classes and generalised overlap of the boxes."""
    import torch
    from torch.nn import functional

    odds, edges = given[..., : len(CLASSES)], given[..., len(CLASSES) :].clamp(-4, 5).exp() * CELL
    wanted = kinds[..., None] == torch.arange(len(CLASSES))
    sure = functional.logsigmoid(torch.where(wanted, odds, -odds))
    weight = (1 - sure.exp()) ** CLASS_FOCUS * torch.where(wanted, 0.35, 0.65)
    entropy = -sure * weight * (~unjudged)[..., None]
    own = kinds >= 0
    count = own.sum().clamp(min=1)

    def area(four: Any) -> Any:
        return (four[..., 0] + four[..., 2]) * (four[..., 1] + four[..., 3])

    edges, reach = edges[own], reach[own]
    shared, round_ = area(torch.minimum(edges, reach)), area(torch.maximum(edges, reach))
    both = area(edges) + area(reach) - shared
    overlap = shared / both - (round_ - both) / round_
    return 2 * entropy.sum() / count + (1 - overlap).sum() / count


def learn(folder: Path, out: Path, steps: int, begin: Path | None) -> None:
    """Train for so many steps, from weights that were trained before if they are given."""
    import torch

    torch.set_num_threads(1)
    drawn, rng = read(folder), np.random.default_rng(1)
    layers = network().train()
    if begin is not None:
        with torch.no_grad(), np.load(begin) as weights:
            outputs(layers, torch.from_numpy(_batch(rng, drawn, 64)[0]), dict(weights))
    kept = torch.optim.swa_utils.AveragedModel(
        layers, multi_avg_fn=torch.optim.swa_utils.get_ema_multi_avg_fn(MEAN), use_buffers=True
    )
    flat = [part for part in layers.parameters() if part.ndim == 1]
    deep = [part for part in layers.parameters() if part.ndim > 1]
    groups = [{"params": deep, "weight_decay": WEIGHT_DECAY}, {"params": flat, "weight_decay": 0.0}]
    optimiser = torch.optim.AdamW(groups, betas=(0.9, SPREAD))
    told = 0.0
    for number in range(1, steps + 1):
        for group in optimiser.param_groups:
            group["lr"] = rate_at(number, steps)
        pictures, *truth = (torch.from_numpy(part) for part in _batch(rng, drawn, EACH))
        with torch.autocast("cpu", dtype=torch.bfloat16):
            given = outputs(layers, pictures)
        wrong = loss(given.float(), *truth)
        optimiser.zero_grad()
        wrong.backward()
        torch.nn.utils.clip_grad_norm_(layers.parameters(), 10.0)
        optimiser.step()
        kept.update_parameters(layers)
        told += float(wrong.detach()) / TOLD
        if number % TOLD == 0:
            print(f"{number} of {steps}: {told:.3f}", flush=True)
            told = 0.0
        if number % KEPT == 0 or number == steps:
            np.savez(out, **finished(kept.module))


def rate_at(number: int, steps: int) -> float:
    """The rate of learning of a step: it rises at first, stays, and falls to nothing."""
    left = (steps - number) / (steps * COOL_DOWN)
    return RATE * min(1.0, number / WARM_UP, math.sin(math.pi / 2 * min(left, 1.0)) ** 2) + 1e-5


def _batch(rng: np.random.Generator, drawn: Drawn, count: int) -> tuple[np.ndarray, ...]:
    """Some pictures, most of them nearer or farther, half mirrored, some with noise or other colours, each in a light of its own."""
    looks = [
        _nearer(rng, _searched(drawn.files[number]), drawn.rows[number])
        for number in rng.choice(len(drawn.files), count, replace=False)
    ]
    seen = np.stack([picture for picture, _ in looks]).astype(np.float32)
    for at, (_, truths) in enumerate(looks):
        truths[:, 0] = at
    kinds, unjudged, reach = targets(count, np.concatenate([truths for _, truths in looks]))
    mirrored = np.flatnonzero(rng.random(count) < 0.5)
    seen[mirrored], kinds[mirrored] = seen[mirrored][:, :, ::-1], kinds[mirrored][:, :, ::-1]
    unjudged[mirrored] = unjudged[mirrored][:, :, ::-1]
    reach[mirrored] = reach[mirrored][:, :, ::-1][..., [2, 1, 0, 3]]
    for at in np.flatnonzero(rng.random(count) < SWAPPED):
        seen[at] = seen[at][..., rng.permutation(3)]
    seen *= rng.uniform(0.8, 1.2, (count, 1, 1, 3)).astype(np.float32)
    for at in np.flatnonzero(rng.random(count) < NOISY):
        seen[at] += rng.standard_normal(seen[at].shape, dtype=np.float32) * rng.uniform(1.0, 6.0)
    np.clip(seen, 0, 255, out=seen)
    return np.ascontiguousarray(seen.transpose(0, 3, 1, 2)), kinds, unjudged, reach


def _searched(file: bytes) -> np.ndarray:
    """The picture as the detector sees it."""
    image = Image.open(io.BytesIO(file))
    image.draft("RGB", SEARCHED)
    return np.asarray(image.convert("RGB"))


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


def finished(layers: Any) -> dict[str, np.ndarray]:
    """The layers with their norms folded into them, as the robot reads them."""
    made: dict[str, np.ndarray] = {}
    for name in LAYERS:
        own = layers[name]
        weights = own["conv"].weight.detach().numpy().transpose(2, 3, 1, 0)
        if name == "head":
            added = own["conv"].bias.detach().numpy()
        else:
            norm = own["norm"]
            scale = (norm.weight / (norm.running_var + norm.eps).sqrt()).detach().numpy()
            weights, added = weights * scale, norm.bias.detach().numpy() - norm.running_mean.numpy() * scale
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
    learning.add_argument("--steps", type=int, default=7000)
    learning.add_argument("--begin", type=Path, help="weights to begin with")
    asked = parser.parse_args()
    if asked.command == "draw":
        draw(asked.folder, asked.seed, asked.count)
    else:
        learn(asked.folder, asked.out, asked.steps, asked.begin)


if __name__ == "__main__":
    main()
