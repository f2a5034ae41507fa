"""What a graph view shows of a robot's nodes and topics: hidden ones left out, topics that are alike folded into one box. No Kivy."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass

__all__ = ["FOLD", "GROUP", "NODE", "SILENT", "TOPIC", "Box", "Shown", "shown"]

NODE, TOPIC, GROUP = "node", "topic", "group"
"""Kinds of boxes; a group stands for topics with the same publishers and subscribers."""
FOLD = 5
"""From so many topics that are alike on they are folded."""
MAX_BOXES = 600
"""What is more is left out and said."""
SILENT = ("/rosout", "/rosout_agg", "/parameter_events", "/client_count", "/connected_clients", "/statistics")
"""Topics that join every node with every other and tell nothing of the robot."""


@dataclass(frozen=True, slots=True)
class Box:
    """One box of the graph."""

    name: str
    """Unique."""
    kind: str
    topics: tuple[str, ...] = ()
    """Those of a group."""


@dataclass(frozen=True, slots=True)
class Shown:
    """What is drawn."""

    boxes: Mapping[str, Box]
    edges: tuple[tuple[str, str], ...]
    """From who tells to what is told, and from there to who listens."""
    left_out: int = 0
    """Boxes for which there is no room."""

    def beside(self, name: str) -> frozenset[str]:
        """A box and all that it is joined with; of a topic and a group its nodes, of a node its topics."""
        near = {other for edge in self.edges if name in edge for other in edge}
        return frozenset({name, *near})

    def found(self, words: str) -> frozenset[str]:
        """Boxes whose names hold all the words, in any case; none for no word."""
        wanted = words.lower().split()
        if not wanted:
            return frozenset()
        return frozenset(
            box.name
            for box in self.boxes.values()
            if any(all(word in one.lower() for word in wanted) for one in (box.topics or (_plain(box.name),)))
        )

    def box_of(self, topic: str) -> str:
        """Name of the box in which a topic is; empty where it is in none."""
        name = key(TOPIC, topic)
        if name in self.boxes:
            return name
        return next((box.name for box in self.boxes.values() if topic in box.topics), "")


def key(kind: str, name: str) -> str:
    """Unique name of a box: a node and a topic may be called alike."""
    return f"{kind} {name}"


def _plain(name: str) -> str:
    return name.partition(" ")[2]


def shown(
    nodes: Iterable[str],
    publishes: Mapping[str, Collection[str]],
    subscribes: Mapping[str, Collection[str]],
    *,
    hide: bool = True,
    fold: bool = True,
    unfolded: Collection[str] = (),
) -> Shown:
    """What is drawn of a graph. `hide` leaves `SILENT` topics out, and nodes that have no others; `unfolded` names groups."""
    topics = sorted({*publishes, *subscribes})
    if hide:
        topics = [topic for topic in topics if not _is_silent(topic)]
    alike: dict[tuple[frozenset[str], frozenset[str]], list[str]] = defaultdict(list)
    for topic in topics:
        alike[frozenset(publishes.get(topic, ())), frozenset(subscribes.get(topic, ()))].append(topic)
    boxes = [Box(key(NODE, node), NODE) for node in sorted(set(nodes))]
    edges: list[tuple[str, str]] = []
    for (tells, listens), found in alike.items():
        group = Box(key(GROUP, found[0]), GROUP, tuple(found))
        folded = fold and len(found) >= FOLD and group.name not in unfolded
        for box in [group] if folded else [Box(key(TOPIC, topic), TOPIC) for topic in found]:
            boxes.append(box)
            edges += [(key(NODE, node), box.name) for node in sorted(tells)]
            edges += [(box.name, key(NODE, node)) for node in sorted(listens)]
    joined = {name for edge in edges for name in edge}
    kept = [box for box in boxes if box.name in joined or not hide]
    there = {box.name: box for box in kept[:MAX_BOXES]}
    told = tuple(edge for edge in edges if edge[0] in there and edge[1] in there)
    return Shown(there, told, max(0, len(kept) - MAX_BOXES))


def _is_silent(topic: str) -> bool:
    return topic in SILENT or topic.endswith("/transition_event")
