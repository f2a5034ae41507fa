"""The demo's report: a picture and a line with expected and measured values for each step."""

from __future__ import annotations

import json
import sys
import time
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from kivy.core.window import Window
from kivy.graphics.opengl import GL_RGBA, GL_UNSIGNED_BYTE, glReadPixels
from PIL import Image

__all__ = ["Check", "Report", "Step", "picture"]


@dataclass(frozen=True)
class Check:
    """One expectation."""

    expected: str
    measured: Any
    ok: bool
    timed: bool = False
    """It depends on how fast this machine is, and on who else uses it."""


@dataclass
class Step:
    """One step of the story."""

    name: str
    seconds: float = 0.0
    """How long it took [s]."""
    picture: str = ""
    checks: list[Check] = field(default_factory=list)

    @property
    def ok(self) -> bool:
        """Every expectation held."""
        return all(check.ok for check in self.checks)


def picture(path: Path) -> None:
    """Draw a frame and save the screen, also where frames are skipped (`examples.demo.frames`)."""
    Window.on_draw()
    width, height = Window.size
    raw = glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE)
    image = Image.frombytes("RGBA", (width, height), raw).transpose(Image.Transpose.FLIP_TOP_BOTTOM)
    image.convert("RGB").save(path)


class Report:
    """Collects steps into a folder: `NN-name.png` for each, and `summary.json`."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        for old in [*folder.glob("*.png"), *folder.glob("summary.json")]:
            old.unlink()
        self.folder = folder
        self.steps: list[Step] = []
        self.done = ""
        """Name of the last step that ended."""
        self.fault = ""
        """Why the story ended early; empty when it did not."""
        self._started = time.monotonic()

    def begin(self, name: str) -> None:
        """Begin a step."""
        self.steps.append(Step(name))
        self._started = time.monotonic()

    def check(self, expected: str, measured: Any, ok: bool, *, timed: bool = False) -> bool:
        """Note an expectation of the present step, `timed` if the machine's speed decides it too; returns `ok`."""
        measured = round(measured, 3) if isinstance(measured, float) else measured
        self.steps[-1].checks.append(Check(expected, measured, bool(ok), timed))
        return bool(ok)

    def end(self) -> None:
        """End the step with a picture and a line for the terminal."""
        step = self.steps[-1]
        step.seconds = round(time.monotonic() - self._started, 2)
        self.done = step.name
        step.picture = f"{len(self.steps):02}-{step.name}.png"
        picture(self.folder / step.picture)
        print(f"{'ok  ' if step.ok else 'FAIL'} {len(self.steps):2} {step.name}", flush=True)
        for check in step.checks:
            print(f"        {'' if check.ok else 'NOT '}{check.expected}: {check.measured}", flush=True)

    def snapshot(self, name: str) -> None:
        """One more picture of the present step."""
        picture(self.folder / f"{len(self.steps):02}-{name}.png")

    @property
    def failures(self) -> list[str]:
        """What did not hold, each in one sentence."""
        found = [
            f"{step.name}: expected {check.expected}, measured {check.measured}"
            for step in self.steps
            for check in step.checks
            if not check.ok
        ]
        return [*found, self.fault] if self.fault else found

    def write(self, **about: Any) -> int:
        """Write summary.json with `about` the run; returns the exit code, 1 when something did not hold."""
        summary = {
            "ok": not self.failures,
            **about,
            "failures": self.failures,
            "steps": [{"ok": step.ok, **asdict(step)} for step in self.steps],
        }
        (self.folder / "summary.json").write_text(json.dumps(summary, indent=1, default=str) + "\n")
        for failure in self.failures:
            print(f"demo: {failure}", file=sys.stderr)
        return 1 if self.failures else 0
