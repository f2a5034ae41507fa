"""Train the network for STOP: `python -m scripts.stop_word speak BOOK DIR`, then `… draw DIR` a few times, then `… learn DIR OUT`.

`speak` has every voice of `scripts/stop_word/voices.py` that is installed say its part of a book (any text file with enough sentences),
`draw` makes windows of what they say, alone, at once and in noise, and `learn` writes the weights for
`app/inputs/voice/recognition/stop_word.npz`. `tell DIR WEIGHTS` says how well voices that nothing was drawn from are heard, and how often
they are taken for STOP, from which `SURE` of `spotter.py` was chosen; `python -m bench stop_word` judges with yet others.
It needs `pip install torch` besides the voices, which nothing else of Pilothouse does.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.recognition.conformer import Conformer, unpacked
from app.inputs.voice.recognition.stop_word import StopWord
from scripts.stop_word.learning import learn
from scripts.stop_word.phrases import phrases, prose
from scripts.stop_word.telling import tell
from scripts.stop_word.voices import ESPEAK, VOICES, load, speak
from scripts.stop_word.windows import Drawer, Voice, voice_of

HELD = ("kal", *ESPEAK[12:])
"""Voices that nothing is drawn from: by them it is chosen from where on it is sure."""
NATURAL = 3.0, 0.5
"""How often a natural voice speaks, and one of espeak-ng."""
SENTENCES = 300, 36
"""Of each natural voice, and of each of espeak-ng, none said twice."""
SHARE_SAID = 0.3
"""Of the windows that have the word."""
EACH = 2000
"""Windows of a file."""


def main() -> None:
    """Do one of the steps."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    steps = parser.add_subparsers(dest="step", required=True)
    speaking = steps.add_parser("speak", help="record the voices")
    speaking.add_argument("book", type=Path)
    drawing = steps.add_parser("draw", help="make windows")
    drawing.add_argument("--seed", type=int, default=1)
    drawing.add_argument("--files", type=int, default=10)
    drawing.add_argument(
        "--known", type=Path, help="weights that are there already: draw more of what they err in"
    )
    learning = steps.add_parser("learn", help="learn from all windows")
    learning.add_argument("--rounds", type=int, default=8)
    learning.add_argument("--seed", type=int, default=1)
    telling = steps.add_parser("tell", help="say how well the held voices are heard")
    for each in (speaking, drawing, learning, telling):
        each.add_argument("folder", type=Path)
    learning.add_argument("out", type=Path)
    telling.add_argument("weights", type=Path)
    chosen = parser.parse_args()
    _STEPS[chosen.step](chosen)


def _speak(chosen: argparse.Namespace) -> None:
    chosen.folder.mkdir(parents=True, exist_ok=True)
    sentences, first = prose(chosen.book), 0
    for number, name in enumerate(VOICES):
        count = SENTENCES[name in ESPEAK]
        said = list(phrases(sentences[first : first + count]))
        first += count
        try:
            seconds = speak(name, said, chosen.folder / f"{name}.voice.npz", number)
        except (OSError, ImportError) as missing:
            print(f"{name}: not recorded: {missing}")
            continue
        print(f"{name}: {seconds / 60:.1f} min", flush=True)


def _voices(folder: Path, held: bool, model: Conformer, tokens: list[str]) -> Iterator[tuple[str, Voice]]:
    for path in sorted(folder.glob("*.voice.npz")):
        name = path.name.removesuffix(".voice.npz")
        if (name in HELD) == held:
            yield name, voice_of(load(path), model, tokens)


def _draw(chosen: argparse.Namespace) -> None:
    model, tokens = _phonemes()
    voices = dict(_voices(chosen.folder, False, model, tokens))
    weights = {name: NATURAL[name in ESPEAK] for name in voices}
    known = _odds(chosen.known) if chosen.known else lambda _: 0.0
    for number in range(chosen.files):
        windows, truth = Drawer(voices, weights, (chosen.seed, number)).windows(
            EACH, SHARE_SAID, model, known
        )
        np.savez(chosen.folder / f"{chosen.seed}_{number}.windows.npz", windows=windows, truth=truth)
        print(f"{number + 1} of {chosen.files}", flush=True)


def _learn(chosen: argparse.Namespace) -> None:
    drawn = [np.load(path) for path in sorted(chosen.folder.glob("*.windows.npz"))]
    windows, truth = (np.concatenate([file[name] for file in drawn]) for name in ("windows", "truth"))
    weights: dict[str, Any] = dict(learn(windows, truth, chosen.rounds, chosen.seed))
    np.savez(chosen.out, **weights)


def _tell(chosen: argparse.Namespace) -> None:
    model, tokens = _phonemes()
    for line in tell(dict(_voices(chosen.folder, True, model, tokens)), model, _odds(chosen.weights)):
        print(line, flush=True)


def _odds(path: Path) -> Callable[[NDArray[np.float32]], float]:
    """The greatest log odds of weights in a window."""
    with np.load(path) as file:
        word = StopWord({name: file[name].astype(np.float32) for name in file.files})
    return lambda frames: float(word.ends(frames).max())


def _phonemes() -> tuple[Conformer, list[str]]:
    """The phoneme model of the package `hama`, and its signs."""
    from hama.vocab import Vocabulary

    weights = resources.files("hama.assets").joinpath("asr_waveform.hama").read_bytes()
    return Conformer(unpacked(weights)), [*Vocabulary.load(None).decoder, "<wb>", "<blank>"]


_STEPS = {"speak": _speak, "draw": _draw, "learn": _learn, "tell": _tell}

if __name__ == "__main__":
    main()
