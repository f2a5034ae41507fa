"""The report of a bench, as a table for people and as plain values for programs."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from bench.support.figures import Outcome, Samples
from bench.support.harness import Result

__all__ = ["as_json", "document", "number", "table", "write"]

HEAD = ("figure", "value", "range", "target", "", "against", "its value", "better by")
STATED = ("stated, not of this run", "better by")
DASH = "–"


def number(value: float) -> str:
    """Three significant figures; a dash for NaN."""
    if math.isnan(value):
        return DASH
    if value == 0 or math.isinf(value):
        return f"{value:g}"
    places = max(0, 2 - math.floor(math.log10(abs(value))))
    return f"{value:.{places}f}"


def row(outcome: Outcome) -> tuple[str, ...]:
    """One line of the table."""
    figure, peer = outcome.figure, outcome.peer
    sign = "≤" if figure.better == "less" else "≥"
    return (
        figure.name,
        f"{number(outcome.ours.median)} {figure.unit}",
        f"{number(outcome.ours.low)}…{number(outcome.ours.high)}",
        _targets(figure.target, figure.share, sign, ""),
        outcome.verdict,
        figure.against or DASH,
        f"{number(peer.median)} {figure.unit}" if peer.values else DASH,
        _times(outcome.ratio),
    )


def stated(outcome: Outcome) -> tuple[str, ...]:
    """What a line says of another program that was not measured in this run."""
    told = outcome.figure.stated
    if told is None:
        return DASH, DASH
    return f"{told.of}: {number(told.value)} {outcome.figure.unit}", _times(outcome.stated_ratio)


def columns(rows: Sequence[Sequence[str]]) -> str:
    """The rows under each other, each column as wide as its widest cell."""
    widths = [max(len(cell) for cell in column) for column in zip(*rows, strict=True)]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in rows
    )


def quiet(result: Result) -> str:
    """The machine's noise in one line."""
    noise = result.noise
    return (
        f"noise: the fixed loop took 1…{number(max(noise.slowness, default=math.nan))} times its best, "
        f"others had the core {max(noise.waiting, default=math.nan):.0%} of it at worst, "
        f"load {number(max(noise.load, default=math.nan))}"
    )


def table(result: Result) -> str:
    """The figures of one bench for the terminal."""
    rows = [HEAD, *map(row, result.outcomes)]
    if any(outcome.figure.stated for outcome in result.outcomes):
        more = [STATED, *map(stated, result.outcomes)]
        rows = [(*one, *other) for one, other in zip(rows, more, strict=True)]
    return f"{result.name}\n{columns(rows)}\n{quiet(result)}\n"


def as_json(result: Result) -> dict[str, Any]:
    """The result as plain values; NaN is null."""
    noise = result.noise
    return {
        "bench": result.name,
        "how": result.how,
        "noise": {"slowness": noise.slowness, "waiting": noise.waiting, "load": noise.load},
        "figures": [_figure(outcome) for outcome in result.outcomes],
    }


def write(path: Path, value: object) -> None:
    """Write JSON, making the folder."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(value, indent=1, allow_nan=False) + "\n")


def document(results: Iterable[dict[str, Any]], conditions: str) -> str:
    """`docs/performance.md`: every figure with the value reached, from what `as_json` gave."""
    parts = [OPENING.format(conditions=conditions)]
    for result in results:
        figures = result["figures"]
        lines = ["figure", "reached", "target", "", "against", "better by"]
        cells = [_cells(figure) for figure in figures]
        if any(figure.get("stated") for figure in figures):
            lines += STATED
            cells = [[*one, *_stated_cells(figure)] for one, figure in zip(cells, figures, strict=True)]
        rows = [lines, ["---"] * len(lines), *cells]
        body = "\n".join(f"| {' | '.join(cells)} |" for cells in rows)
        slow = max(result["noise"]["slowness"], default=math.nan)
        load = max(result["noise"]["load"], default=math.nan)
        parts.append(
            f"## {result['bench']}\n\n{result['how']}\n\n{body}\n\n"
            f"While it ran the machine's fixed loop took up to {number(slow)} times its best; load {number(load)}.\n"
        )
    return "\n".join(parts)


OPENING = """# Performance

Every figure that was promised, the value reached, and what it was measured against. `make bench` measures them again;
`python -m bench --doc` writes this page from `out/bench/`. A value is the median of the repeats, with the least
and the greatest in brackets; ours and the other way take turns, so that a busy minute of the machine hits both.
*Better by* says how many times. What is *stated* is another program's value from an earlier measurement on another machine,
where that program could not be run beside ours.

Measured on {conditions}.
"""


def _cells(figure: dict[str, Any]) -> list[str]:
    ours, peer, unit = figure["ours"], figure["peer"], figure["unit"]
    value = f"{_shown(ours['median'])} {unit} ({_shown(ours['low'])}…{_shown(ours['high'])})"
    sign = "≤" if figure["better"] == "less" else "≥"
    target = _targets(figure["target"], figure.get("share"), sign, unit)
    against = f"{figure['against']}: {_shown(peer['median'])} {unit}" if peer["values"] else DASH
    better = _times(figure["ratio"])
    verdict = "**missed**" if figure["verdict"] == "MISSED" else figure["verdict"]
    return [figure["meaning"], value, target, verdict, against, better]


def _targets(target: float | None, share: float | None, sign: str, unit: str) -> str:
    """As in `≤ 2.00 s, ≤ 1.60 of its value`; a dash where there is none."""
    told = [] if target is None else [f"{sign} {number(target)} {unit}".rstrip()]
    told += [] if share is None else [f"{sign} {number(share)} of its value"]
    return ", ".join(told) or DASH


def _stated_cells(figure: dict[str, Any]) -> list[str]:
    told = figure.get("stated")
    if told is None:
        return [DASH, DASH]
    return [f"{told['of']}: {number(told['value'])} {figure['unit']}", _times(told["ratio"])]


def _times(ratio: float | None) -> str:
    return DASH if ratio is None or math.isnan(ratio) else f"{number(ratio)}×"


def _shown(value: float | None) -> str:
    return DASH if value is None else number(value)


def _figure(outcome: Outcome) -> dict[str, Any]:
    figure = outcome.figure
    return {
        "name": figure.name,
        "meaning": figure.meaning,
        "unit": figure.unit,
        "target": figure.target,
        "share": figure.share,
        "better": figure.better,
        "verdict": outcome.verdict,
        "ours": _samples(outcome.ours),
        "against": figure.against,
        "peer": _samples(outcome.peer),
        "ratio": _finite(outcome.ratio),
        "stated": figure.stated
        and {
            "of": figure.stated.of,
            "value": figure.stated.value,
            "ratio": _finite(outcome.stated_ratio),
        },
    }


def _samples(samples: Samples) -> dict[str, Any]:
    return {
        "median": _finite(samples.median),
        "low": _finite(samples.low),
        "high": _finite(samples.high),
        "spread": _finite(samples.spread),
        "values": [_finite(value) for value in samples.values],
    }


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
