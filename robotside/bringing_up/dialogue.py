"""The dialogue at a terminal: which robot, with which payloads, where, and by which protocols."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from bridge.core.address import BadAddress, host_and_port
from robotside.bringing_up.robot_file import Choice, before, keep
from robotside.commands.user_mistake import UserMistake
from robotside.core.config import Config, GatewaySettings, ServeSettings
from robotside.core.installing import how_to_install
from robotside.gateways.addresses import is_here

if TYPE_CHECKING:  # loaded when somebody is asked
    from robotside.gateways.adapter import Adapter

__all__ = ["NotAnswered", "Simulated", "ask", "can_ask", "chosen"]

EVERYWHERE, HERE = "0.0.0.0", "127.0.0.1"  # noqa: S104 - said by the user
_SIM, _ROS, _OTHER = "sim:", "ros:", "another"
_USUAL = "usual"
_ROLES = {
    "watch": "watch, and STOP",
    "drive": "drive, and give tasks",
    "none": "STOP only",
}


class NotAnswered(Exception):
    """The user ended the dialogue; nothing was kept."""


@dataclass(frozen=True, slots=True)
class Simulated:
    """What can be simulated, as `sim.catalogue` lists it."""

    robots: tuple[Mapping[str, Any], ...] = ()
    worlds: tuple[Mapping[str, Any], ...] = ()

    def robot(self, name: str) -> Mapping[str, Any]:
        """The robot of that name; nothing for another."""
        return next((each for each in self.robots if each["name"] == name), {})


def can_ask() -> bool:
    """The library that asks is there."""
    from importlib.util import find_spec

    return find_spec("questionary") is not None


def ask(file: Path, simulated: Simulated) -> None:
    """Ask with what `file` says as answers, and keep the new ones there. NotAnswered, UserMistake, or BadConfig."""
    if not can_ask():
        raise UserMistake(f"--ask needs questionary: {how_to_install('gateways')} brings it.")
    known = before(file)
    try:
        choice = chosen(simulated, known)
    except (KeyboardInterrupt, EOFError) as ended:
        raise NotAnswered from ended
    keep(file, choice)


def chosen(simulated: Simulated, known: Config) -> Choice:
    """What the user answers; KeyboardInterrupt when it ends the dialogue."""
    serve = known.serve
    robot = _robot(simulated, serve)
    offered = simulated.robot(robot.removeprefix(_SIM))
    world = _world(simulated, offered, serve) if offered else ""
    payloads, without = _payloads(offered, serve) if offered else ((), serve.without)
    host, pair = _reach(serve)
    port = _port("Port of rosbridge, for the app and ROS tools", serve.port, 9090)
    http_port = _port("Port of the web site, with STOP, cameras and usage", serve.http_port, 8080, given=port)
    return Choice(
        robot,
        world,
        payloads,
        without,
        host,
        port,
        http_port,
        pair,
        _gateways(known.gateways),
    )


def _robot(simulated: Simulated, serve: ServeSettings) -> str:
    """The robot, as `--robot` has it."""
    from questionary import Choice as Item

    old = serve.robot or ""
    items = [
        Item(f"{each['name']:<11} simulated: {each['description']}", value=f"{_SIM}{each['name']}")
        for each in simulated.robots
    ]
    values = [str(item.value) for item in items]
    if old and old not in values and ("," in old or not old.startswith(_ROS)):
        items.append(Item(f"{old}, as now", value=old))  # several robots, say
    items.append(Item("another     a robot behind a rosbridge server", value=_OTHER))
    usual = _OTHER if old.startswith(_ROS) and "," not in old else old or [*values, _OTHER][0]
    found = _select("Which robot?", items, usual)
    if found != _OTHER:
        return found
    address = old.removeprefix(_ROS) if old.startswith(_ROS) else "ws://192.168.1.7:9090"
    return _ROS + _text("Address of its rosbridge server:", address, _address_problem)


def _world(simulated: Simulated, offered: Mapping[str, Any], serve: ServeSettings) -> str:
    from questionary import Choice as Item

    fitting = [each for each in simulated.worlds if offered["name"] in each["robots"]]
    items = [Item(f"{each['name']:<12} {each['description']}", value=each["name"]) for each in fitting]
    names = [each["name"] for each in fitting]
    if serve.world and serve.world.endswith(".toml"):
        items.append(Item(f"{serve.world}, as now", value=serve.world))
        names.append(serve.world)
    usual = serve.world if serve.world and serve.world in names else str(offered["home"])
    return _select("In which world?", items, usual)


def _payloads(offered: Mapping[str, Any], serve: ServeSettings) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The payloads that it carries besides its own, and those of its own that are off."""
    from questionary import Choice as Item

    own, more = offered["own"], offered["payloads"]
    items = [
        Item(f"{_words(name)} (its own)", value=(name, ""), checked=name not in serve.without) for name in own
    ]
    for name in more:
        title = f"{_words(name)} (one more)" if name in own else _words(name)
        items.append(Item(title, value=("", name), checked=name in serve.payloads))
    if not items:
        return (), serve.without
    chosen_ones = _checkbox("Which payloads? What is not chosen is off.", items)
    kept = [name for name in serve.without if name not in own]  # what the file says and nobody was asked
    kept += [name for name in own if (name, "") not in chosen_ones]
    return tuple(name for _, name in chosen_ones if name), tuple(kept)


def _words(name: str) -> str:
    return name.replace("_", " ")


def _reach(serve: ServeSettings) -> tuple[str, bool]:
    """The address to listen on, and whether to open pairing while nobody is paired."""
    from questionary import Choice as Item

    items = [
        Item("this computer only", value=HERE),
        Item("phones and computers of the network, once they are paired", value=EVERYWHERE),
    ]
    old = serve.host or HERE
    if old not in (HERE, EVERYWHERE):
        items.append(Item(f"{old}, as now", value=old))
    host = _select("Who can reach it?", items, old)
    return host, serve.pair if host == old and serve.host else not is_here(host)


def _port(message: str, old: int | None, usual: int, *, given: int = 0) -> int:
    """A port other than the one that is `given` to rosbridge, 0 for a free one each."""

    def problem(text: str) -> str:
        taken = given and not _port_problem(text) and int(text) == given
        return f"Port {given} is that of rosbridge; take another." if taken else _port_problem(text)

    return int(_text(f"{message}:", str(usual if old is None else old), problem))


def _gateways(known: Mapping[str, GatewaySettings]) -> dict[str, GatewaySettings]:
    """All gateways that are wanted or were known, by name."""
    from questionary import Choice as Item

    from robotside.gateways.discovery import adapters, missing_package

    there = adapters()
    items = []
    for name, adapter in there.items():
        lacking = missing_package(adapter)
        why = f"needs {lacking}: {how_to_install('gateways')}" if lacking else None
        on = name in known and known[name].on and not lacking
        items.append(Item(f"{name:<11} {adapter.doc}", value=name, checked=on, disabled=why))
    can_be = any(not item.disabled for item in items)  # a list of which none can be chosen is an error there
    wanted = _checkbox("Which protocols beside rosbridge and HTTP?", items) if can_be else []
    found = {name: _with(each, on=False) for name, each in known.items() if name not in wanted}
    return found | {name: _gateway(there[name], known.get(name)) for name in wanted}


def _gateway(adapter: Adapter, known: GatewaySettings | None) -> GatewaySettings:
    """What one gateway needs, in few answers."""
    from questionary import Choice as Item

    old = known or GatewaySettings()
    url = _text(f"{adapter.name}: URL, {_forms(adapter)}:", old.url or adapter.default, _url_problem(adapter))
    user = password = ""
    if _is_broker(adapter, url) and "@" not in url:
        user = _text(f"{adapter.name}: user at the broker, empty for none:", old.user)
        if user:
            password = _password(f"{adapter.name}: password of {user}:", old.password)
    roles = [Item(said, value=role) for role, said in _ROLES.items()]
    roles.insert(0, Item("usual: watch, and on this computer what its programs may", value=_USUAL))
    role: Any = _select(f"{adapter.name}: what may who shows no token?", roles, old.role or _USUAL)
    return _with(old, on=True, url=url, user=user, password=password, role=None if role == _USUAL else role)


def _forms(adapter: Adapter) -> str:
    """How its URLs are written: that of others by its first scheme, and that of a broker of the robot's own."""
    from robotside.gateways.gateway_url import OWN, SITE

    scheme, port = next((each for each in adapter.schemes.items() if each[0] != OWN), (OWN, 0))
    if scheme == SITE:
        return f"{SITE}:/PATH"
    prefix = "" if scheme in adapter.listens else "/PREFIX"
    own = f", or {adapter.default} for a broker of its own" if adapter.default.startswith(OWN) else ""
    return f"{scheme}://HOST:{port}{prefix}{own}"


def _is_broker(adapter: Adapter, url: str) -> bool:
    """The gateway goes to a broker of others, which may want to know who comes."""
    from robotside.gateways.gateway_url import SITE

    return url.partition(":")[0] not in (*adapter.listens, SITE)


def _with(settings: GatewaySettings, **changes: Any) -> GatewaySettings:
    return msgspec.structs.replace(settings, **changes)


def _select(message: str, items: list[Any], usual: str) -> str:
    import questionary

    return str(questionary.select(message, items, default=usual, instruction=" ").unsafe_ask())


def _checkbox(message: str, items: list[Any]) -> list[Any]:
    import questionary

    said = "(space chooses, Enter goes on)"
    return list(questionary.checkbox(message, items, instruction=said).unsafe_ask())


def _text(message: str, usual: str, problem: Callable[[str], str] = lambda _: "") -> str:
    import questionary

    def check(text: str) -> bool | str:
        return problem(text.strip()) or True

    return str(questionary.text(message, default=usual, validate=check).unsafe_ask()).strip()


def _password(message: str, old: str) -> str:
    """A password, which is not shown; an empty answer keeps the `old` one."""
    import questionary

    kept = " (Enter keeps it)" if old else ""
    return str(questionary.password(f"{message}{kept}").unsafe_ask()) or old


def _address_problem(text: str) -> str:
    try:
        host_and_port(text)
    except BadAddress as problem:
        return str(problem)
    return ""


def _port_problem(text: str) -> str:
    ok = text.isascii() and text.isdigit() and int(text[:6]) <= 65535
    return "" if ok else "A port is 0 to 65535; 0 takes a free one."


def _url_problem(adapter: Adapter) -> Callable[[str], str]:
    from robotside.gateways.discovery import read_wish

    def problem(text: str) -> str:
        try:
            read_wish(f"{adapter.name}={text}")
        except ValueError as mistake:
            return str(mistake)
        return ""

    return problem
