"""The whole walk, a process for each language and size of text: `python -m tests.layout_lint [--jobs 2] [--only WORDS] [--anew]`.

What is wrong is written to out/layout_lint/report.md, grouped by fault and by where it is. A walk that was broken off goes on
where it was, as long as no file of the app has changed. The exit code is 1 for a fault that tests/layout_lint/known.toml does not name, and
for one that is named there and was not found.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from tests.headless import Stage, prepare

HERE = Path(__file__).parent
REPOSITORY = HERE.parents[1]
OUT = REPOSITORY / "out" / "layout_lint"
CODE = ("app", "widgets", "tests/layout_lint")
"""Folders whose change makes what was found old."""
POLL_PERIOD = 0.5
"""How often the processes are looked at [s]."""


def main() -> int:
    """Walk, or be one of the processes that do; returns the exit code."""
    options = _options()
    if options.way:
        walk_one(options.way, options.scenes, Path(options.file))
        return 0
    OUT.mkdir(parents=True, exist_ok=True)
    from tests.layout_lint.known import verdict
    from tests.layout_lint.ways import WHOLE

    ways = [way.name for way in WHOLE if options.only.lower() in way.name.lower()]
    run_all(ways, options.scenes, jobs=options.jobs, anew=options.anew)
    found = [json.loads(path_of(way).read_text(encoding="utf-8")) for way in ways]
    (OUT / "report.md").write_text(report(found), encoding="utf-8")
    whole = not options.only and not options.scenes
    sentences = verdict({fault["name"] for one in found for fault in one["findings"]}, whole=whole)
    print(
        *sentences,
        f"{sum(one['looks'] for one in found)} looks; {OUT.relative_to(REPOSITORY)}/report.md",
        sep="\n",
    )
    return bool(sentences)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="layout_lint", description=__doc__)
    parser.add_argument("--jobs", type=int, default=2, help="processes side by side")
    parser.add_argument("--only", default="", help="ways whose name has these words, as in 'de 130'")
    parser.add_argument(
        "--scenes", default="", help="scenes of these names, with commas between; all without"
    )
    parser.add_argument("--anew", action="store_true", help="do not go on where the last walk was broken off")
    parser.add_argument("--way", default="", help=argparse.SUPPRESS)
    parser.add_argument("--file", default="", help=argparse.SUPPRESS)
    return parser.parse_args()


def path_of(way: str) -> Path:
    """Where a process leaves what it found."""
    return OUT / f"{way.replace(' ', '_').replace('%', 'percent')}.json"


def stamp(scenes: str) -> str:
    """What is found is as of this code and these scenes."""
    told = hashlib.sha256(scenes.encode())
    for folder in CODE:
        for path in sorted((REPOSITORY / folder).rglob("*")):
            if path.suffix in (".py", ".toml", ".mo") and path.name != "known.toml":
                told.update(path.read_bytes())
    return told.hexdigest()


def walk_one(name: str, scenes: str, file: Path) -> None:
    """Walk in one way, and write what is wrong into `file`."""
    prepare("logic")
    from tests.layout_lint.walk import Walk
    from tests.layout_lint.ways import WHOLE

    way = next(way for way in WHOLE if way.name == name)
    begun = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        stage = Stage()
        walk = Walk(stage, Path(folder), lambda scene: print(scene, flush=True))
        findings = [
            {
                "name": one.name,
                "kind": one.fault.kind,
                "where": one.fault.where,
                "words": one.fault.words,
                "scene": one.scene,
                "at": one.at,
            }
            for one in walk.over(way, scenes.split(",") if scenes else None)
        ]
        stage.close()
    told = {
        "stamp": stamp(scenes),
        "looks": walk.looks,
        "seconds": time.monotonic() - begun,
        "findings": findings,
    }
    partial = file.with_suffix(".part")
    partial.write_text(json.dumps(told, ensure_ascii=False, indent=1), encoding="utf-8")
    partial.rename(file)


def run_all(ways: Sequence[str], scenes: str, *, jobs: int, anew: bool) -> None:
    """A process for each way, `jobs` at a time; what an earlier walk has found of this code is kept."""
    now = stamp(scenes)
    left = [way for way in ways if anew or not _is_of(path_of(way), now)]
    print(f"{len(ways) - len(left)} of {len(ways)} ways are walked already", flush=True)
    running: dict[str, subprocess.Popen[Any]] = {}
    try:
        while left or running:
            while left and len(running) < jobs:
                way = left.pop(0)
                running[way] = _begin(way, scenes)
            time.sleep(POLL_PERIOD)
            for way in [way for way, one in running.items() if one.poll() is not None]:
                code = running.pop(way).returncode
                if code:
                    raise SystemExit(f"{way}: ended by {code}; see {path_of(way).with_suffix('.log')}")
                told = json.loads(path_of(way).read_text(encoding="utf-8"))
                print(
                    f"{way}: {told['looks']} looks, {len(told['findings'])} findings, {told['seconds']:.0f} s; {len(left)} to go",
                    flush=True,
                )
    finally:
        for one in running.values():
            one.terminate()
            one.wait()


def _is_of(path: Path, now: str) -> bool:
    return path.exists() and json.loads(path.read_text(encoding="utf-8"))["stamp"] == now


def _begin(way: str, scenes: str) -> subprocess.Popen[Any]:
    file = path_of(way)
    with file.with_suffix(".log").open("wb") as log:
        return subprocess.Popen(
            [
                sys.executable,
                "-m",
                "tests.layout_lint",
                "--way",
                way,
                "--scenes",
                scenes,
                "--file",
                str(file),
            ],
            cwd=REPOSITORY,
            stdout=log,
            stderr=subprocess.STDOUT,
        )


def report(found: Sequence[dict[str, Any]]) -> str:
    """What is wrong as text, the most frequent fault first."""
    return "\n".join(_lines(found)) + "\n"


def _lines(found: Sequence[dict[str, Any]]) -> Iterator[str]:
    groups: dict[str, list[dict[str, str]]] = defaultdict(list)
    for one in found:
        for fault in one["findings"]:
            groups[fault["name"]].append(fault)
    yield f"# {len(groups)} faults in {sum(one['looks'] for one in found)} looks\n"
    for name, faults in sorted(groups.items(), key=lambda item: -len(item[1])):
        scenes = sorted({fault["scene"] for fault in faults})
        yield f"## {name}: {len(faults)} times\n"
        yield f"scenes: {', '.join(scenes)}\n"
        yield from (
            f"- [{fault['scene']}; {fault['at']}] {fault['words']}"
            for fault in faults[:: max(1, len(faults) // 6)][:7]
        )
        yield ""


if __name__ == "__main__":
    sys.exit(main())
