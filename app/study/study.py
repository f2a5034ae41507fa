"""The study: who is prompted for what by which method, in which order, and how far it has come.

trials = Trials(Plan(user="7", row=7, methods=("button", "voice", "shake")), now=time.monotonic)
trials.begin()
trials.update(now)                # shows the next prompt, and notes one that nobody answered
trials.on_command("pause", "voice")  # the answer

Within subjects: everybody uses every method, in an order of a balanced Latin square, and triggers every command as often. No
Kivy in here; a pause, the end of the app and a crash lose nothing but the prompt that was shown.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

__all__ = ["ANSWER_TIMEOUT", "Block", "Plan", "Prompt", "Trials", "latin_row", "plan_of", "saved"]

ANSWER_TIMEOUT = 8.0
"""A prompt that nobody answered for so long is missed [s]."""
PROMPT_GAP = (1.5, 3.5)
"""Between an answer and the next prompt, drawn by lot so that nobody answers by rhythm [s]."""
COMMANDS = ("stop", "pause", "resume", "patrol", "go_home")
"""Those of the paper's patrol robot."""
TRIGGERS = 10
"""Prompts for each command and method, as in the paper."""
POSTURES = ("standing", "walking")
MAX_TRIGGERS = 50


def latin_row(count: int, row: int) -> list[int]:
    """Row `row` of a balanced Latin square of `count`: 0 … count - 1, each before and after each other equally often.

    Williams 1949: 0, 1, n-1, 2, n-2, … plus the row; where `count` is odd every second row is one of those backwards.
    """
    zigzag = [(place + 1) // 2 if place % 2 else (count - place // 2) % count for place in range(count)]
    shift, backwards = (row // 2, row % 2) if count % 2 else (row, 0)
    order = [(one + shift) % count for one in zigzag]
    return order[::-1] if backwards else order


@dataclass(frozen=True, slots=True)
class Block:
    """One method in one posture: its prompts in their order."""

    method: str
    posture: str
    prompts: tuple[str, ...]
    """Intents."""


@dataclass(frozen=True, slots=True)
class Plan:
    """What one person is asked for. The same figures make the same prompts, today and after a restart."""

    user: str
    """Chosen by whoever leads the study: a number or letters, never a name."""
    row: int = 1
    """Which person it is, 1 or more: the row of the Latin square, and the lot of the prompts."""
    methods: tuple[str, ...] = ("button", "voice", "shake")
    postures: tuple[str, ...] = ("standing",)
    triggers: int = TRIGGERS
    commands: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Method to the intents it can say, where those are not all of `COMMANDS`."""

    def blocks(self) -> list[Block]:
        """One for each method and posture; the postures change places from person to person."""
        order = latin_row(len(self.methods), self.row - 1)
        postures = self.postures if self.row % 2 else self.postures[::-1]
        return [
            Block(self.methods[number], posture, self._prompts(self.methods[number], posture))
            for number in order
            for posture in postures
        ]

    def _prompts(self, method: str, posture: str) -> tuple[str, ...]:
        """Rounds of every command once, each round by lot, none twice in a row where there is more than one."""
        lot = random.Random(f"{self.row} {method} {posture}")
        prompts: list[str] = []
        commands = self.commands.get(method, COMMANDS)
        for _ in range(self.triggers):
            round_ = lot.sample(commands, len(commands))
            if prompts and len(round_) > 1 and prompts[-1] == round_[0]:
                round_[0], round_[-1] = round_[-1], round_[0]
            prompts += round_
        return tuple(prompts)


@dataclass(frozen=True, slots=True)
class Prompt:
    """What somebody is asked for just now."""

    id: str
    intent: str
    method: str
    posture: str
    user: str
    at: float
    """When it was shown [s, our clock]."""


def _ignore(*_: object) -> None:
    """Nobody listens."""


class Trials:
    """One person's way through the plan.

    `stage` is `ready` (before a block), `gap`, `prompt`, `paused`, `tlx` (after a block), `sus` (after all) or `done`.
    """

    def __init__(self, plan: Plan, *, now: Callable[[], float], block: int = 0, trial: int = 0) -> None:
        """Begins before a block, at a trial of it, as `saved` told: behind the last one the form is asked for, and

        what lies beyond that is the end."""
        self.plan, self._now = plan, now
        self.blocks = plan.blocks()
        self.block, self.trial = max(0, min(block, len(self.blocks))), max(0, trial)
        self.stage = "ready"
        self.prompt: Prompt | None = None
        """What is asked for now; None between two."""
        self.last = ""
        """What became of the last prompt, in words."""
        self.on_missed: Callable[[Prompt], object] = _ignore
        """Called with a prompt that nobody answered in time."""
        self.on_moved: Callable[[], object] = _ignore
        """Called when it has come farther: time to save."""
        self._next, self._tries, self._lot = math.inf, 0, random.Random()
        if self.block >= len(self.blocks):
            self.stage = "sus" if block == len(self.blocks) else "done"
        elif self.trial >= len(self.now_block.prompts):
            self.stage = "tlx"

    @property
    def now_block(self) -> Block:
        """The block that is under way, or that comes next; after the end the last."""
        return self.blocks[min(self.block, len(self.blocks) - 1)]

    @property
    def running(self) -> bool:
        """Prompts are shown: what the method understands belongs to the study."""
        return self.stage in ("gap", "prompt")

    @property
    def left(self) -> float:
        """Until the prompt is missed [s]; NaN between prompts."""
        return max(0.0, self.prompt.at + ANSWER_TIMEOUT - self._now()) if self.prompt else math.nan

    def begin(self) -> None:
        """Begin a block, or go on after a pause."""
        if self.stage in ("ready", "paused"):
            self._rest()

    def pause(self) -> None:
        """Wait; the prompt that is shown is asked for again later, and nothing is noted of it."""
        if self.running:
            self.stage, self.prompt = "paused", None

    def update(self, now: float) -> None:
        """Show the next prompt when its time has come, and give up one that nobody answers."""
        if self.stage == "gap" and now >= self._next:
            self._ask(now)
        elif self.prompt is not None and now - self.prompt.at >= ANSWER_TIMEOUT:
            missed = self.prompt
            self.last = "Nothing was understood."
            self.on_missed(missed)
            self._advance()

    def on_command(self, intent: str, method: str) -> Prompt | None:
        """The block's method understood that: the prompt it answers; None where nobody was asked, or by that method not."""
        prompt = self.prompt
        if prompt is None or method != prompt.method:
            return None
        self.last = "Understood." if intent == prompt.intent else "Understood as something else."
        self._advance()
        return prompt

    def filled(self) -> None:
        """The form that is asked for is filled in, or left out."""
        if self.stage == "tlx":
            self.block, self.trial = self.block + 1, 0
            self.stage = "ready" if self.block < len(self.blocks) else "sus"
        elif self.stage == "sus":
            self.stage = "done"
        self.on_moved()

    def _ask(self, now: float) -> None:
        block = self.now_block
        self._tries += 1
        name = f"{self.plan.user}-{self.block + 1}-{self.trial + 1}-{self._tries}"
        intent = block.prompts[self.trial]
        self.prompt = Prompt(name, intent, block.method, block.posture, self.plan.user, now)
        self.stage = "prompt"

    def _advance(self) -> None:
        self.prompt, self.trial = None, self.trial + 1
        if self.trial < len(self.now_block.prompts):
            self._rest()
        else:
            self.stage = "tlx"
        self.on_moved()

    def _rest(self) -> None:
        self.stage, self._next = "gap", self._now() + self._lot.uniform(*PROMPT_GAP)


def saved(trials: Trials) -> dict[str, Any]:
    """What `plan_of` needs to go on, as JSON values."""
    plan = trials.plan
    return {
        "user": plan.user,
        "row": plan.row,
        "methods": list(plan.methods),
        "postures": list(plan.postures),
        "triggers": plan.triggers,
        "commands": {method: list(commands) for method, commands in plan.commands.items()},
        "block": trials.block + (trials.stage == "done"),
        "trial": trials.trial,
    }


def plan_of(kept: Any, methods: Sequence[str], intents: Sequence[str]) -> tuple[Plan, int, int] | None:
    """Plan, block and trial of what was saved; None where it means nothing. Only `methods` and `intents` are known."""
    if not isinstance(kept, dict):
        return None
    try:
        commands = {str(one): tuple(many) for one, many in dict(kept["commands"]).items()}
        plan = Plan(
            user=str(kept["user"]),
            row=int(kept["row"]),
            methods=tuple(kept["methods"]),
            postures=tuple(kept["postures"]),
            triggers=int(kept["triggers"]),
            commands=commands,
        )
        sound = _sound(plan, methods, intents)
        return (plan, int(kept["block"]), int(kept["trial"])) if sound else None
    except (KeyError, TypeError, ValueError, OverflowError):
        return None


def _sound(plan: Plan, methods: Sequence[str], intents: Sequence[str]) -> bool:
    """It can be led; TypeError where there are lists or tables in place of names."""
    return bool(
        plan.row >= 1
        and 1 <= plan.triggers <= MAX_TRIGGERS
        and plan.methods
        and set(plan.methods) <= set(methods)
        and plan.postures
        and set(plan.postures) <= set(POSTURES)
        and all(many and set(many) <= set(intents) for many in plan.commands.values())
    )
