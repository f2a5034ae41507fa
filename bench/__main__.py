"""Command line of the benches, `python -m bench [NAME…] [--data DIR] [--json FILE] [--doc [CONDITIONS]] [--COUNT N…]`: measures, prints a table, writes out/bench/."""

from __future__ import annotations

import argparse
import json
import math
import os
import platform
import sys
import traceback
from collections.abc import Sequence
from pathlib import Path

from bench.support.harness import COUNTS, ON_DEMAND, Context, Result, load, measure, names
from bench.support.noise import Noise
from bench.support.report import as_json, document, table, write
from bridge.discovery.domain import VARIABLE

ROOT = Path(__file__).parents[1]
OUT = ROOT / "out" / "bench"
PAGE = ROOT / "docs" / "performance.md"


def options(arguments: Sequence[str], known: Sequence[str]) -> argparse.Namespace:
    """What the command line asks for; SystemExit 2 with one sentence for a name that is none."""
    parser = argparse.ArgumentParser(prog="python -m bench", description="Measures Pilothouse.")
    parser.add_argument(
        "name",
        nargs="*",
        help=f"benches to run: {', '.join(known)}; default: all but {', '.join(sorted(ON_DEMAND))}",
    )
    parser.add_argument(
        "--data", type=Path, metavar="DIR", help="folder of recordings for the benches of a recogniser"
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="file for all results")
    parser.add_argument(
        "--doc",
        nargs="?",
        const="",
        metavar="CONDITIONS",
        help="write docs/performance.md from out/bench, with these remarks on the machine; measures only the named benches",
    )
    for name, (usual, meaning) in COUNTS.items():
        parser.add_argument(
            f"--{name}", type=float, metavar="N", default=usual, help=f"{meaning}; default: {usual:g}"
        )
    asked = parser.parse_args(arguments)
    unknown = [name for name in asked.name if name not in known]
    if unknown:
        parser.exit(2, f"There is no bench {unknown[0]!r}; there are {', '.join(known)}.\n")
    if asked.data and not asked.data.is_dir():
        parser.exit(2, f"--data must be a folder, and {asked.data} is none.\n")
    for name in COUNTS:
        if not 0 < getattr(asked, name) < math.inf:
            parser.exit(2, f"--{name} must be above 0, and {getattr(asked, name):g} is not.\n")
    return asked


def conditions() -> str:
    """The machine in half a line."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    models = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    model = models[0] if models else "an unknown processor"
    return (
        f"{os.cpu_count()} cores of {model}, {platform.system()}, Python {platform.python_version()}, "
        "no GPU (Mesa llvmpipe draws)"
    )


def run(name: str, context: Context) -> Result | None:
    """Measure one bench and print its results; None when it crashed, which is printed too."""
    try:
        result = measure(name, load(name), context, Noise())
    except Exception:  # noqa: BLE001 - one broken bench must not hide the others' figures
        traceback.print_exc()
        print(f"{name}: crashed\n", flush=True)
        return None
    write(OUT / f"{name}.json", as_json(result))
    print(table(result), flush=True)
    return result


def main(arguments: Sequence[str]) -> int:
    """0 for any figures; 1 when a bench crashed."""
    known = names()
    asked = options(arguments, known)
    os.environ[VARIABLE] = f"bench-{os.getpid()}"  # robots of others are neither measured nor stopped
    usual = [name for name in known if name not in ON_DEMAND]
    chosen = asked.name or (usual if asked.doc is None else [])
    context = Context(asked.data, {name: getattr(asked, name) for name in COUNTS})
    results = [run(name, context) for name in chosen]
    found = [result for result in results if result]
    missed = [f"{r.name}.{o.figure.name}" for r in found for o in r.outcomes if o.verdict == "MISSED"]
    if missed:
        print(f"missed: {', '.join(missed)}")
    if asked.json:
        write(asked.json, [as_json(result) for result in found])
    if asked.doc is not None:
        pages = [json.loads(path.read_text()) for name in known if (path := OUT / f"{name}.json").exists()]
        PAGE.write_text(document(pages, f"{conditions()}{asked.doc}"))
    return 0 if len(found) == len(results) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
