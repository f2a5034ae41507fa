"""From what can be done on the glass to a tree of groups of at most four, in which what is done often costs few presses.

On every level the first child costs one press, the second two: n steps and one to do it or go in. What has been done often, or
is likely, stands alone and takes the cheapest places of a tree that is looked for as that of a Huffman code with letters of unequal
cost; everything else keeps together with its neighbours, in the order of the glass.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple

from app.inputs.switch_access.scan.target import Target

__all__ = ["MAX_CHILDREN", "PRIOR_COUNT", "Group", "Planner", "cost", "leaves", "plan"]

MAX_CHILDREN = 4
"""Children of a group, at most."""
BEAM_WIDTH = 10
"""Unfinished trees that are kept while the cheapest is looked for; with 300 none cheaper is found for 16 actions."""
MAX_ALONE = 16
"""So many may stand alone beside the groups of the glass."""
MIN_LEARNED = 3.0
"""Done so often, something stands alone."""
PRIOR_COUNT = 10.0
"""What is likely before anything was learned counts as so many times done, over all together."""
MAX_TREES = 64
"""Trees that are kept; the one that was not looked at for longest goes."""
PRIOR_WEIGHTS = {
    "yes": 10.0,
    "no": 6.0,
    "pause": 8.0,
    "resume": 8.0,
    "start": 6.0,
    "patrol": 6.0,
    "go_home": 5.0,
    "surface": 5.0,
    "end_task": 4.0,
    "take_control": 4.0,
    "faster": 3.0,
    "slower": 3.0,
    "hold": 3.0,
    "land": 3.0,
    "take_off": 3.0,
}
"""How much more likely an intent is than a button without one, before anything was learned; assumed."""


@dataclass(frozen=True, slots=True)
class Group:
    """A level of the tree: its children are stepped over."""

    children: tuple[Group | Target, ...]
    words: str = ""
    """What they have in common, as the container's; empty for nothing."""


class _Node(NamedTuple):
    """A target or a group of them, how likely, and its place in the order of the glass."""

    child: Group | Target
    weight: float
    place: int


def leaves(child: Group | Target) -> Iterator[Target]:
    """Every target in it, in order."""
    if isinstance(child, Target):
        yield child
    else:
        for one in child.children:
            yield from leaves(one)


def cost(group: Group) -> dict[str, int]:
    """Presses from the first child of `group` to each target's name, its own press included."""
    found = {}
    for index, child in enumerate(group.children, 1):
        if isinstance(child, Target):
            found[child.name] = index
        else:
            found |= {name: index + more for name, more in cost(child).items()}
    return found


def plan(targets: Sequence[Target], used: Mapping[str, float] | None = None) -> Group:
    """The tree for these; `used` says how often each name was done before, and `intent:NAME` how often an intent was."""
    nodes = _weighed(targets, used or {})
    hot = sorted((node for node in nodes if _is_hot(node, used or {})), key=lambda node: -node.weight)[
        :MAX_ALONE
    ]
    alone = {id(node.child) for node in hot}
    cold = _contained([node for node in nodes if id(node.child) not in alone], 0)
    if not hot:
        return _root(_folded(cold))
    rest = cold if len(cold) <= MAX_CHILDREN else [*_folded(cold)]
    return _root(_cheapest([*hot, *rest]))


def _root(nodes: Sequence[_Node]) -> Group:
    return Group(tuple(node.child for node in nodes))


def _weighed(targets: Sequence[Target], used: Mapping[str, float]) -> list[_Node]:
    """Smoothed by what is likely, which `PRIOR_COUNT` presses say in all."""
    likely = [max(one.weight, 1e-6) * PRIOR_WEIGHTS.get(one.intent, 1.0) for one in targets]
    whole = sum(likely) or 1.0
    return [
        _Node(one, before * PRIOR_COUNT / whole + _times(one, used), place)
        for place, (one, before) in enumerate(zip(targets, likely, strict=True))
    ]


def _times(target: Target, used: Mapping[str, float]) -> float:
    by_intent = used.get(f"intent:{target.intent}", 0.0) if target.intent else 0.0
    return max(used.get(target.name, 0.0), by_intent)


def _is_hot(node: _Node, used: Mapping[str, float]) -> bool:
    target = node.child
    if not isinstance(target, Target) or target.fixed:
        return False
    return _times(target, used) >= MIN_LEARNED or target.weight * PRIOR_WEIGHTS.get(target.intent, 1.0) > 1.0


def _contained(nodes: Sequence[_Node], depth: int) -> list[_Node]:
    """What shares a container becomes one node, in the order in which the containers are met."""
    met: dict[object, list[_Node]] = {}
    for node in nodes:
        group = node.child.group if isinstance(node.child, Target) else ()
        met.setdefault(group[depth] if len(group) > depth else node.place, []).append(node)
    return [_container(name, inside, depth) for name, inside in met.items()]


def _container(name: object, inside: list[_Node], depth: int) -> _Node:
    words = name if isinstance(name, str) else ""
    first = inside[0].child
    if len(inside) == 1:
        return inside[0]
    if isinstance(first, Target) and first.fixed and len(first.group) == depth + 1:
        return _grouped(inside, words)
    return _grouped(_folded(_contained(inside, depth + 1)), words)


def _grouped(nodes: Sequence[_Node], words: str = "") -> _Node:
    if len(nodes) == 1:
        return nodes[0]
    children = tuple(node.child for node in nodes)
    return _Node(Group(children, words), sum(node.weight for node in nodes), nodes[0].place)


# neighbours stay together


def _folded(nodes: Sequence[_Node]) -> list[_Node]:
    """At most `MAX_CHILDREN`, each of neighbours."""
    if len(nodes) <= MAX_CHILDREN:
        return list(nodes)
    parts, start = [], 0
    for size in _shares(len(nodes)):
        parts.append(_grouped(_folded(nodes[start : start + size])))
        start += size
    return parts


def _shares(count: int) -> tuple[int, ...]:
    """How many of `count` each child of a level is to have: few so that presses are fewest, many evenly, as is easier to learn."""
    if count <= 2 * MAX_CHILDREN:
        return _split(count, 1, count)[1]
    return tuple((count + MAX_CHILDREN - 1 - child) // MAX_CHILDREN for child in range(MAX_CHILDREN))


@lru_cache(maxsize=8192)
def _split(count: int, child: int, whole: int) -> tuple[float, tuple[int, ...]]:
    """Least sum of presses of `count` equal ones on child number `child` and those behind it, and how they are shared out."""
    if count == 0:
        return 0.0, ()
    if child > MAX_CHILDREN:
        return float("inf"), ()
    best: tuple[float, tuple[int, ...]] = float("inf"), ()
    for size in range(1, min(count, whole - 1) + 1):
        behind, shares = _split(count - size, child + 1, whole)
        total = _within(size) + child * size + behind
        if total < best[0]:
            best = total, (size, *shares)
    return best


@lru_cache(maxsize=512)
def _within(count: int) -> float:
    """Least sum of presses of `count` equal ones in a group of their own."""
    return 0.0 if count <= 1 else _split(count, 1, count)[0]


# the frequent in cheap places

Leaf = tuple[int, tuple[int, ...]]
"""What it costs, and which child on each level."""


def _cheapest(nodes: Sequence[_Node]) -> list[_Node]:
    """The children of the tree for these in which the mean of the presses is least, as far as a narrow search finds it."""
    ordered = sorted(nodes, key=lambda node: (-node.weight, node.place))
    if len(ordered) <= MAX_CHILDREN:
        return ordered
    weights = tuple(node.weight for node in ordered)
    shapes = _shapes(weights)
    return _planted(list(zip(ordered, shapes, strict=True)), 0)


def _shapes(weights: tuple[float, ...]) -> list[Leaf]:
    """A leaf for each of `weights`, which fall: grown leaf by leaf, of the trees with equally many only the best are kept."""
    count = len(weights)
    grown: list[dict[tuple[int, ...], list[Leaf]]] = [{} for _ in range(count + 1)]
    for arity in range(2, MAX_CHILDREN + 1):
        _keep(grown, [(place, (place,)) for place in range(1, arity + 1)])
    for size in range(2, count):
        for costs in sorted(grown[size], key=lambda costs: _worth(costs, weights))[:BEAM_WIDTH]:
            for tree in _grow(grown[size][costs]):
                _keep(grown, tree)
    return grown[count][min(grown[count], key=lambda costs: _worth(costs, weights))]


def _keep(grown: list[dict[tuple[int, ...], list[Leaf]]], tree: list[Leaf]) -> None:
    tree = sorted(tree)[: len(grown) - 1]
    grown[len(tree)].setdefault(tuple(leaf[0] for leaf in tree), tree)


def _grow(tree: list[Leaf]) -> Iterator[list[Leaf]]:
    """Each tree in which one leaf has become a group of two to `MAX_CHILDREN`; of leaves that cost the same only the first."""
    tried = set()
    for at, (costs, path) in enumerate(tree):
        if costs in tried:
            continue
        tried.add(costs)
        for arity in range(2, MAX_CHILDREN + 1):
            fresh = [(costs + place, (*path, place)) for place in range(1, arity + 1)]
            yield [*tree[:at], *tree[at + 1 :], *fresh]


def _worth(costs: tuple[int, ...], weights: tuple[float, ...]) -> float:
    """Presses with the likely in cheap leaves; those without a leaf yet are one group of equals on one of them."""
    without = len(weights) - len(costs) + 1
    if without <= 1:
        return sum(cost_ * weight for cost_, weight in zip(costs, weights, strict=True))
    rest = sum(weights[len(costs) - 1 :])
    placed = sorted((*weights[: len(costs) - 1], rest), reverse=True)
    inside = rest * _within(without) / without
    return sum(cost_ * weight for cost_, weight in zip(costs, placed, strict=True)) + inside


def _planted(nodes: list[tuple[_Node, Leaf]], depth: int) -> list[_Node]:
    by_child: dict[int, list[tuple[_Node, Leaf]]] = {}
    for node, leaf in nodes:
        by_child.setdefault(leaf[1][depth], []).append((node, leaf))
    return [
        inside[0][0] if len(inside) == 1 else _grouped(_planted(inside, depth + 1))
        for _, inside in sorted(by_child.items())
    ]


# what stays while a session lasts


class Planner:
    """Keeps the tree of each place for as long as nothing new appears there: what was learned counts from the next start on."""

    def __init__(self, used: Mapping[str, Mapping[str, float]]) -> None:
        """`used` says for each place how often each name was done, and under the place `""` how often each intent was."""
        self._used = {place: dict(names) for place, names in used.items()}
        self._kept: OrderedDict[str, tuple[Group, dict[str, Target]]] = OrderedDict()

    def tree(self, place: str, targets: Sequence[Target]) -> Group:
        """The tree for what is there now; what was there before leaves its place empty."""
        now = {target.name: target for target in targets}
        group, known = self._kept.pop(place, (Group(()), {}))
        if not now.keys() <= known.keys():
            gone = [target for name, target in known.items() if name not in now]
            # nothing of the glass is kept beyond what it is called: the widgets go
            bare = [replace(target, act=_nothing, key=None) for target in targets]
            known = {one.name: one for one in (*bare, *(gone if len(gone) * 2 <= len(now) else ()))}
            group = plan(list(known.values()), self._counts(place))
        self._kept[place] = group, known
        while len(self._kept) > MAX_TREES:
            self._kept.popitem(last=False)
        return Group(tuple(_present(group, now)))

    def _counts(self, place: str) -> dict[str, float]:
        intents = {f"intent:{name}": times for name, times in self._used.get("", {}).items()}
        return {**intents, **self._used.get(place, {})}


def _nothing() -> None:
    """Of what is remembered only."""


def _present(group: Group, now: Mapping[str, Target]) -> Iterator[Group | Target]:
    for child in group.children:
        if isinstance(child, Target):
            if child.name in now:
                yield now[child.name]
            continue
        inside = tuple(_present(child, now))
        if len(inside) == 1:
            yield inside[0]
        elif inside:
            yield Group(inside, child.words)
