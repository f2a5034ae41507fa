"""`python -m bench [NAME…] [--data DIR] [--json FILE]`: measures, prints a table, writes out/bench/NAME.json."""

from __future__ import annotations

import argparse
import importlib
import json
import sys
from pathlib import Path

from bench.figures import Figure, machine, table

BENCHES = {
    "codec": "messages to text and back, against json and dicts",
    "broadcast": "one message to many clients, against encoding for each",
    "patrol": "how much faster than real time a patrol runs",
    "robotside": "what the robot's computer pays",
    "handheld": "first frame, live widgets, main thread, memory",
    "touch": "from the finger to the robot's port",
    "video": "from the simulator's render to the app's texture",
}
OUT = Path("out/bench")


def _arguments(argv: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m bench", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(BENCHES))
    parser.add_argument("--data", type=Path, metavar="DIR", help="recordings, for benches that judge by some")
    parser.add_argument("--json", type=Path, metavar="FILE", help="all figures in one file as well")
    return parser.parse_args(argv)


def _write(path: Path, figures: list[Figure], noise: Figure) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    record = {"machine": noise.record(), "figures": [figure.record() for figure in figures]}
    path.write_text(json.dumps(record, indent=1, ensure_ascii=False) + "\n")


def main(argv: list[str] | None = None) -> int:
    """Run the benches named, or all; 0 when done, 2 for a name that is none."""
    arguments = _arguments(argv)
    unknown = [name for name in arguments.names if name not in BENCHES]
    if unknown:
        print(f"bench: there is no {unknown[0]}; there are {', '.join(BENCHES)}.", file=sys.stderr)
        return 2
    noise, found = machine(), []
    for name in arguments.names or BENCHES:
        print(f"bench: {name}: {BENCHES[name]}", file=sys.stderr, flush=True)
        figures = list(importlib.import_module(f"bench.{name}").measure())
        _write(OUT / f"{name}.json", figures, noise)
        found += figures
    if arguments.json:
        _write(arguments.json, found, noise)
    print(table([noise, *found, machine()]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
