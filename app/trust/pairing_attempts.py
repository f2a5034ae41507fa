"""Attempts to pair, carried out in the network thread and told through the mailbox."""

from __future__ import annotations

import concurrent.futures
import logging
from collections.abc import Callable, Coroutine
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from app.link.feeds import Mailbox
from bridge.core.network_thread import NetworkThread
from bridge.trust.pairing import BadPairing, PairLink
from widgets.core.language import tr

if TYPE_CHECKING:
    from bridge.client.pairing import Paired  # when somebody pairs, for a quick start

__all__ = ["PAIRING", "Attempt", "PairingAttempts"]

log = logging.getLogger(__name__)

PAIRING = "pairing"
"""Channel of the mailbox, on which each `Attempt` that ended is queued."""


@dataclass(frozen=True, slots=True)
class Attempt:
    """An attempt that ended."""

    number: int
    """As `PairingAttempts` gave it."""
    paired: Paired | None
    """What it left; None where it failed."""
    problem: str = ""
    """Why it failed, as a sentence."""


class PairingAttempts:
    """Pairs with one robot at a time. Called in the UI thread."""

    def __init__(
        self, mailbox: Mailbox, network: NetworkThread, client_name: str, now: Callable[[], float]
    ) -> None:
        """`client_name` is what this handheld is called; `now` is our clock [s]."""
        self._mailbox, self._network, self._now = mailbox, network, now
        self.client_name = client_name
        """What this handheld is called for the next robot."""
        self._number = 0
        self._running: concurrent.futures.Future[None] | None = None

    def by_link(self, link: PairLink) -> int:
        """Pair with the robot of a link; returns the number of the attempt. One that goes on ends."""
        from bridge.client.pairing import pair_by_link

        return self._start(pair_by_link(link, self.client_name))

    def by_code(self, url: str, code: str) -> int:
        """Pair with the robot at `url` by the code that it shows; returns the number of the attempt."""
        from bridge.client.pairing import pair_by_code

        return self._start(pair_by_code(url, code, self.client_name))

    def cancel(self) -> None:
        """End the attempt that goes on; nothing more is told of it."""
        self._number += 1
        if self._running is not None:
            self._running.cancel()
            self._running = None

    def _start(self, work: Coroutine[Any, Any, Paired]) -> int:
        self.cancel()
        self._running = self._network.start(self._run(self._number, work))
        return self._number

    async def _run(self, number: int, work: Coroutine[Any, Any, Paired]) -> None:
        from bridge.client.pairing import PairingFailed

        try:
            ended = Attempt(number, await work)
        except (PairingFailed, BadPairing) as failure:
            ended = Attempt(number, None, str(failure))
        except Exception:
            log.exception("Pairing failed")
            ended = Attempt(number, None, tr("Pairing failed for an unknown reason; the log says more."))
        self._mailbox.queue(PAIRING, ended, self._now())
