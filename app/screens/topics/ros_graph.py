"""Who publishes and subscribes what on a robot: its nodes are asked by rosapi, a few at a time, while somebody looks.

Everything here happens in the UI thread.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from app.link.channels import ANSWER, LINK, Answer
from app.link.feeds import Post
from app.session.session import Session
from bridge.msgs.rosapi_msgs import NodeDetailsRequest, NodeDetailsResponse, NodesRequest, NodesResponse
from widgets.core.language import tr, trn

__all__ = ["MAX_AT_ONCE", "MAX_NODES", "REFRESH_PERIOD", "GraphWatch", "RosGraph"]

REFRESH_PERIOD = 5.0
"""Between the end of one round of questions and the next [s]."""
ROUND_TIMEOUT = 30.0
"""A round that takes longer is given up [s]: an answer may have been lost with its link."""
MAX_AT_ONCE = 4
"""Questions that wait for their answers: the robot has more to do."""
MAX_NODES = 200
"""Nodes that are asked in one round."""
MAX_TOPICS = 1000
"""Of one node, each way."""
MAX_NAME = 200
"""Letters of a name; what is longer is no name of ROS."""
MAX_LISTED = 6
"""Nodes of a topic that are named; of more the rest is counted."""
NODES, DETAILS = "/rosapi/nodes", "/rosapi/node_details"


@dataclass(frozen=True, slots=True)
class RosGraph:
    """As it was found in one round."""

    nodes: tuple[str, ...] = ()
    publishes: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Nodes that publish each topic, by name; a topic that nobody is known to publish is not there."""
    subscribes: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Nodes that subscribe to each topic."""
    unknown: int = 0
    """Nodes that said nothing, or were too many to be asked."""

    @classmethod
    def of(cls, nodes: Sequence[str], told: Mapping[str, NodeDetailsResponse], unknown: int = 0) -> RosGraph:
        """Put together what nodes told of themselves."""
        publishes: dict[str, list[str]] = {}
        subscribes: dict[str, list[str]] = {}
        for node in sorted(told):
            for topics, into in (
                (told[node].publishing, publishes),
                (told[node].subscribing, subscribes),
            ):
                for topic in _names(topics)[:MAX_TOPICS]:
                    into.setdefault(topic, []).append(node)
        return cls(
            tuple(sorted(nodes)),
            {topic: tuple(found) for topic, found in publishes.items()},
            {topic: tuple(found) for topic, found in subscribes.items()},
            unknown,
        )


class GraphWatch:
    """The graph of the robot that is on the glass, asked anew now and then while `look` is on."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self.graph: RosGraph | None = None
        """As it was found last; None before."""
        self.problem = ""
        """Why there is none, in one sentence; empty while that is not known or there is one."""
        self._looking = False
        self._begun = self._ended = -math.inf
        self._busy = False
        self._nodes: list[str] = []
        self._waiting: deque[str] = deque()
        self._asked: set[str] = set()
        self._told: dict[str, NodeDetailsResponse] = {}
        self._unknown = 0

    def look(self, on: bool) -> None:
        """Somebody looks, or no longer: the rest of a round is left unasked then."""
        self._looking = on
        if not on:
            self._busy = False
            self._waiting.clear()
            self._asked.clear()

    def refresh(self) -> None:
        """Ask at the next tick, and not when it is time to."""
        self._ended = -math.inf

    def tick(self) -> None:
        """Begin a round when it is time to; nothing while nobody looks or there is no connection."""
        now = self._session.now()
        if self._busy and now - self._begun > ROUND_TIMEOUT:
            self._busy, self._ended = False, now
        if not self._looking or self._busy or not self._session.connected:
            return
        offer = self._session.robot.capabilities
        if offer is not None and not offer.rosapi:
            self._fail(tr("This robot tells nothing of its nodes: it runs no rosapi."))
        elif now - self._ended >= REFRESH_PERIOD:
            self._busy, self._begun = True, now
            self._session.link.ask(NODES, NodesRequest(), NodesResponse)

    def on_post(self, channel: str, post: Post) -> bool:
        """Take in what came; True when the graph is another one or there is none any more."""
        if channel == LINK and not self._session.connected:
            self.look(self._looking)
            self._busy = False
            return False
        answer = post.value
        if channel != ANSWER or not self._busy or not isinstance(answer, Answer):
            return False
        if answer.service == NODES:
            return self._on_nodes(answer)
        if answer.service == DETAILS and isinstance(answer.request, NodeDetailsRequest):
            return self._on_details(answer.request.node, answer)
        return False

    def told(self, topic: str) -> str:
        """Who publishes a topic and who subscribes to it, in one or two sentences; empty while that is not known."""
        if self.graph is None:
            return ""
        said = (
            (tr("Published by {nodes}."), self.graph.publishes.get(topic, ())),
            (tr("Subscribed to by {nodes}."), self.graph.subscribes.get(topic, ())),
        )
        return " ".join(words.format(nodes=_listed(nodes)) for words, nodes in said)

    def _on_nodes(self, answer: Answer) -> bool:
        if not isinstance(answer.message, NodesResponse):
            self._end()
            self._fail(tr("This robot tells nothing of its nodes. {reason}").format(reason=answer.problem))
            return True
        self._nodes = sorted(set(_names(answer.message.nodes)))
        self._waiting = deque(self._nodes[:MAX_NODES])
        self._told, self._asked = {}, set()
        self._unknown = max(0, len(self._nodes) - MAX_NODES)
        return self._go_on()

    def _on_details(self, node: str, answer: Answer) -> bool:
        if node not in self._asked:
            return False  # of a round that was given up
        self._asked.discard(node)
        if isinstance(answer.message, NodeDetailsResponse):
            self._told[node] = answer.message
        else:
            self._unknown += 1
        return self._go_on()

    def _go_on(self) -> bool:
        while self._waiting and len(self._asked) < MAX_AT_ONCE:
            node = self._waiting.popleft()
            self._asked.add(node)
            self._session.link.ask(DETAILS, NodeDetailsRequest(node), NodeDetailsResponse)
        if self._asked:
            return False
        self._end()
        if self._nodes and not self._told and self.graph is not None:
            return False  # the link is bad: what was known is better than nothing
        found = RosGraph.of(self._nodes, self._told, self._unknown)
        changed = found != self.graph or bool(self.problem)
        self.graph, self.problem = found, ""
        return changed

    def _end(self) -> None:
        self._busy, self._ended = False, self._session.now()

    def _fail(self, sentence: str) -> None:
        self.graph, self.problem = None, sentence

    @property
    def sentence(self) -> str:
        """Why there is no graph, or what is missing in it; empty for neither."""
        if self.problem:
            return self.problem
        if self.graph is None:
            return tr("Asking the robot for its nodes …") if self._session.connected else ""
        if not self.graph.unknown:
            return ""
        told = trn("{count} node told nothing.", "{count} nodes told nothing.", self.graph.unknown)
        return told.format(count=self.graph.unknown)


def _listed(nodes: Sequence[str]) -> str:
    if not nodes:
        return tr("nobody")
    more = len(nodes) - MAX_LISTED
    shown = ", ".join(nodes[:MAX_LISTED])
    return shown if more <= 0 else tr("{names} and {count} more").format(names=shown, count=more)


def _names(names: Sequence[str]) -> list[str]:
    return [name for name in names if 0 < len(name) <= MAX_NAME]
