"""A robot side that is killed while several clients make it write, and checked again: all that it acknowledged must be there.

Its robot weighs nothing (`bench/support/bodies.py`), so that it starts soon; all else is as users have it.
"""

from __future__ import annotations

import asyncio
import itertools
import json
import os
import random
import signal
import sqlite3
import subprocess
import sys
from contextlib import closing, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed

__all__ = ["Ledger", "Round", "crash", "find_losses"]

ROOT = Path(__file__).parents[2]
RELEASE_SHARE = 0.3
"""Of the rounds, those in which a STOP is released at the beginning."""
RELEASE_HOLD = 1.2
"""As long the release is held [s]."""
EARLY = 0.15
"""Share of the rounds in which it is killed before it serves, while it opens the database."""
MANY = 300
"""Places from which on some are deleted instead."""
LATCHED = ("/places", "/mission", "/control/status")
WRITERS = 4
"""Calls that wait for their answer at once."""


@dataclass
class Ledger:
    """What the clients know for sure, over all rounds."""

    places: dict[str, float] = field(default_factory=dict)
    """x by name of every place whose keeping was acknowledged."""
    gone: set[str] = field(default_factory=set)
    """Names whose deletion was acknowledged."""
    unsure: set[str] = field(default_factory=set)
    """Names of which a change was asked for and not answered."""
    mission: int = 0
    """Laps of the newest mission whose storing was acknowledged; those asked for count upward."""
    asked_mission: int = 0
    """Laps of the newest mission that was requested."""
    events: dict[int, str] = field(default_factory=dict)
    """Text by number of every event that was heard."""
    acknowledged: set[int] = field(default_factory=set)
    """Events whose acknowledgement was acknowledged."""
    stopped: bool = False
    """STOP was acknowledged as kept, and its release was not asked for since."""
    stops: int = 0
    """STOPs that were acknowledged as kept."""
    numbers: itertools.count[int] = field(default_factory=itertools.count)
    sure: int = 0
    """Changes that were acknowledged."""


@dataclass
class Round:
    """What one killing came to."""

    acknowledged: int
    """Changes that were answered with success before the kill."""
    lost: list[str]
    """Records that were acknowledged and are missing or different; empty when all is well."""


async def crash(state: Path, ledger: Ledger, rng: random.Random, early: float = EARLY) -> Round:
    """Start a robot side, look for what was acknowledged in earlier rounds, have it write, kill it at a random instant."""
    before, lost = ledger.sure, list[str]()
    process = _start(state)
    try:
        if rng.random() < early:
            await asyncio.sleep(rng.uniform(0.0, 1.5))
        else:
            client = await Client.to(process)
            lost = await _find_losses(client, ledger)
            if ledger.stopped and rng.random() < RELEASE_SHARE:
                await _release(client, ledger)
            work = [asyncio.create_task(_write(client, ledger, rng)) for _ in range(WRITERS)]
            await asyncio.sleep(rng.uniform(0.0, 0.5))
            os.kill(process.pid, signal.SIGKILL)
            await asyncio.gather(*work)
            await client.close()
            ledger.events.update(client.events)
    finally:
        _kill(process)
    return Round(ledger.sure - before, lost + _whole(state))


async def find_losses(state: Path, ledger: Ledger) -> list[str]:
    """Start the robot side once more and return the records that are not as acknowledged; empty when all is well."""
    process = _start(state)
    try:
        client = await Client.to(process)
        lost = await _find_losses(client, ledger)
        await client.close()
    finally:
        _kill(process)
    return lost


def _whole(state: Path) -> list[str]:
    path = state / "records.sqlite3"
    if not path.exists():
        return []
    with closing(sqlite3.connect(path)) as database:
        found = database.execute("PRAGMA integrity_check").fetchone()[0]
    return [] if found == "ok" else [f"the database is not whole: {found}"]


async def _find_losses(client: Client, ledger: Ledger) -> list[str]:
    """Records that are not as they were acknowledged."""
    places = (await client.latched("/places"))["places"]
    client.ids = {place["name"]: place["id"] for place in places}
    kept = {place["name"]: place["x"] for place in places}
    laps = (await client.latched("/mission"))["laps"]
    stopped = (await client.latched("/control/status"))["stopped"]
    log = await client.ask("/events/get", since=1, boot=await client.boot())
    logged = {event["id"]: event for event in log["events"]}
    oldest = min(logged, default=0)
    sure = {name: x for name, x in ledger.places.items() if name not in ledger.unsure}
    wrong = [f"place {name} is {kept.get(name)}, not {x}" for name, x in sure.items() if kept.get(name) != x]
    wrong += [f"place {name} is there again" for name in ledger.gone & set(kept)]
    if not ledger.mission <= laps <= ledger.asked_mission:
        wrong.append(f"the mission is number {laps}; {ledger.mission} was acknowledged")
    if ledger.stopped and not stopped:
        wrong.append("STOP is forgotten")
    heard = {id: text for id, text in ledger.events.items() if id >= oldest}
    wrong += [
        f"event {id} is lost or another"
        for id, text in heard.items()
        if logged.get(id, {}).get("text") != text
    ]
    wrong += [
        f"event {id} is not acknowledged any more"
        for id in ledger.acknowledged
        if id in logged and not logged[id]["acknowledged_by"]
    ]
    ledger.acknowledged -= {id for id in ledger.acknowledged if not logged.get(id, {}).get("acknowledged_by")}
    # what was asked for and not answered is settled now
    ledger.places = {name: kept[name] for name in {*sure, *ledger.unsure} if name in kept}
    ledger.unsure.clear()
    ledger.mission = laps
    return wrong


async def _write(client: Client, ledger: Ledger, rng: random.Random) -> None:
    """Change one thing after the other until the robot side is gone."""
    changes = (_stop, _new_place, _new_place, _move_place, _delete_place, _mission, _see_to)
    with suppress(ConnectionClosed):
        while True:
            await rng.choice(changes)(client, ledger, rng)


async def _stop(client: Client, ledger: Ledger, _: random.Random) -> None:
    """Press STOP; an answer that says more than that doubts that it would outlast a restart."""
    answer = await client.ask("/stop")
    if answer["success"] and answer["message"] == "Stopped.":
        ledger.stopped = True
        ledger.stops += 1
        ledger.sure += 1


async def _release(client: Client, ledger: Ledger) -> None:
    """Release STOP, whatever the robot answers; from now on it may be pressed or not."""
    ledger.stopped = False
    await client.ask("/control/acquire")
    await client.ask("/stop/hold")
    await asyncio.sleep(RELEASE_HOLD)
    await client.ask("/stop/release")


async def _new_place(client: Client, ledger: Ledger, rng: random.Random) -> None:
    if len(ledger.places) < MANY:
        await _set(client, ledger, f"Place {next(ledger.numbers)}", 0, rng.uniform(-9.0, 9.0))
    else:
        await _delete_place(client, ledger, rng)


async def _move_place(client: Client, ledger: Ledger, rng: random.Random) -> None:
    free = [name for name in client.ids if name in ledger.places and name not in ledger.unsure]
    if free:
        name = rng.choice(free)
        await _set(client, ledger, name, client.ids[name], rng.uniform(-9.0, 9.0))


async def _set(client: Client, ledger: Ledger, name: str, id: int, x: float) -> None:
    ledger.unsure.add(name)
    answer = await client.ask("/places/set", place={"id": id, "name": name, "x": x})
    if not answer["success"]:
        return
    client.ids[name] = answer["id"]
    ledger.places[name] = x
    ledger.unsure.discard(name)
    ledger.sure += 1


async def _delete_place(client: Client, ledger: Ledger, rng: random.Random) -> None:
    free = [name for name in client.ids if name in ledger.places and name not in ledger.unsure]
    if len(ledger.places) > 20 and free:
        name = rng.choice(free)
        ledger.unsure.add(name)
        await client.ask("/places/delete", id=client.ids.pop(name))
        ledger.gone.add(name)
        del ledger.places[name]
        ledger.unsure.discard(name)
        ledger.sure += 1


async def _mission(client: Client, ledger: Ledger, _: random.Random) -> None:
    ledger.asked_mission += 1
    laps = ledger.asked_mission
    answer = await client.ask("/mission/set", mission={"laps": laps})
    if answer["success"]:
        ledger.mission = max(ledger.mission, laps)
        ledger.sure += 1


async def _see_to(client: Client, ledger: Ledger, rng: random.Random) -> None:
    new = [id for id in client.events if id not in ledger.acknowledged]
    if new:
        id = rng.choice(new)
        if (await client.ask("/events/acknowledge", ids=[id]))["success"]:
            ledger.acknowledged.add(id)
            ledger.sure += 1


class Client:
    """One connection that asks and hears."""

    def __init__(self, socket: ClientConnection) -> None:
        self.events: dict[int, str] = {}
        """Text by number of what was heard on /events."""
        self.ids: dict[str, int] = {}
        """Of the places that it made, by name."""
        self._socket = socket
        self._numbers = itertools.count()
        self._answers: dict[str, asyncio.Future[Any]] = {}
        loop = asyncio.get_running_loop()
        self._latched = {topic: loop.create_future() for topic in LATCHED}
        self._reading = asyncio.create_task(self._read())

    @classmethod
    async def to(cls, process: subprocess.Popen[str]) -> Client:
        """Connect to a robot side once it says that it is ready."""
        while "ready" not in (
            line := await asyncio.to_thread(process.stdout.readline if process.stdout else str)
        ):
            if not line:
                raise RuntimeError("The robot side did not start.")
        url = next(word.removeprefix("bridge=") for word in line.split() if word.startswith("bridge="))
        client = cls(await connect(url, max_size=None))
        for topic in ("/events", *client._latched):
            await client._send(op="subscribe", topic=topic)
        return client

    async def ask(self, service: str, **arguments: object) -> Any:
        """Call a service; ConnectionClosed when the robot side is gone."""
        id = f"call {next(self._numbers)}"
        future = self._answers[id] = asyncio.get_running_loop().create_future()
        await self._send(op="call_service", service=service, id=id, args=arguments)
        return await future

    async def latched(self, topic: str) -> Any:
        """The first message of a latched topic."""
        async with asyncio.timeout(10.0):
            return await asyncio.shield(self._latched[topic])

    async def boot(self) -> str:
        """Identity of the log of events."""
        events = (await self.ask("/events/get", since=0, boot=""))["events"]
        return str(events[-1]["boot"]) if events else ""

    async def close(self) -> None:
        """End the connection."""
        await self._socket.close()
        await self._reading

    async def _send(self, **operation: object) -> None:
        await self._socket.send(json.dumps(operation))

    async def _read(self) -> None:
        closed = ConnectionClosed(None, None)
        with suppress(ConnectionClosed):
            async for text in self._socket:
                self._handle(json.loads(text))
        for future in self._answers.values():
            if not future.done():
                future.set_exception(closed)
                future.exception()  # the caller may be gone

    def _handle(self, message: dict[str, Any]) -> None:
        if message["op"] == "service_response":
            future = self._answers.pop(message["id"])
            if message["result"]:
                future.set_result(message["values"])
            else:
                future.set_exception(RuntimeError(message["values"]))
        elif message["op"] == "publish" and message["topic"] == "/events":
            self.events[message["msg"]["id"]] = message["msg"]["text"]
        elif message["op"] == "publish":
            first = self._latched[message["topic"]]
            if not first.done():
                first.set_result(message["msg"])


def _start(state: Path) -> subprocess.Popen[str]:
    serve = (
        "serve",
        "--robot",
        "sim:patrol",
        "--port",
        "0",
        "--http-port",
        "0",
        "--state",
        str(state),
        "--with-parent",
    )
    return subprocess.Popen(
        [sys.executable, "-m", "bench.support.bodies", *serve],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )


def _kill(process: subprocess.Popen[str]) -> None:
    with suppress(ProcessLookupError):
        os.kill(process.pid, signal.SIGKILL)
    process.wait()
    if process.stdout:
        process.stdout.close()
