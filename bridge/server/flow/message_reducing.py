"""Smaller pictures and coarser maps, made in a worker thread, because they take too long for the event loop."""

from __future__ import annotations

import asyncio
import logging
from concurrent.futures import ThreadPoolExecutor

from bridge.core.async_tasks import cancel_all
from bridge.core.errors import BridgeError
from bridge.protocol import Reduction
from bridge.server.flow.outgoing_messages import OutgoingMessage
from bridge.server.flow.priority_lanes import Stream
from bridge.server.flow.send_queue import SendQueue

__all__ = ["MessageReducer"]

log = logging.getLogger(__name__)


class _Work:
    """The reduction of one topic's messages in one way; the newest message wins."""

    def __init__(self) -> None:
        self.message: OutgoingMessage | None = None
        self.streams: dict[Stream, SendQueue] = {}


class MessageReducer:
    """Reduces each message once for all who want it the same way, one at a time for each topic and way."""

    def __init__(self) -> None:
        self._works: dict[tuple[str, Reduction], _Work] = {}
        self._tasks: set[asyncio.Task[None]] = set()
        self._worker: ThreadPoolExecutor | None = None

    def offer(self, queue: SendQueue, stream: Stream, message: OutgoingMessage) -> None:
        """Reduce `message`, then offer it to `queue`; a newer one replaces one that still waits."""
        reduction = stream.form.reduction
        if reduction is None:
            queue.offer(stream, message)
            return
        key = (stream.topic, reduction)
        work = self._works.get(key)
        if work is None:
            work = self._works[key] = _Work()
            task = asyncio.create_task(self._run(key, work))
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)
        work.message = message
        work.streams[stream] = queue

    async def close(self) -> None:
        """Cancel all reductions."""
        await cancel_all(self._tasks)
        worker, self._worker = self._worker, None
        if worker is not None:
            worker.shutdown(wait=False, cancel_futures=True)

    async def _run(self, key: tuple[str, Reduction], work: _Work) -> None:
        try:
            while work.message is not None:
                message, work.message = work.message, None
                streams, work.streams = work.streams, {}
                try:
                    await self._in_thread(message, key[1])
                except BridgeError as error:
                    log.warning("%s is not sent: %s", key[0], error)
                    continue
                for stream, queue in streams.items():
                    if not stream.gone:
                        queue.offer(stream, message)
        except Exception:
            log.exception("%s could not be made smaller", key[0])
        finally:
            del self._works[key]

    async def _in_thread(self, message: OutgoingMessage, reduction: Reduction) -> None:
        if self._worker is None:
            self._worker = ThreadPoolExecutor(1, "bridge-reducing")
        await asyncio.get_running_loop().run_in_executor(self._worker, message.reduced, reduction)
