"""Films that are made once for all who want the same, for as long as somebody looks."""

from __future__ import annotations

import asyncio
import logging
import math
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager, contextmanager
from types import ModuleType

from bridge.core.errors import BridgeError
from robotside.gateways.video.newest_picture import NewestPicture, Pace
from robotside.gateways.video.video_encoder import Encoded, VideoEncoder, library
from robotside.gateways.video.views import View

__all__ = ["KEY_PERIOD", "MAX_ENCODINGS", "MAX_QUEUED", "FilmViewer", "FullError", "SharedEncodings"]

log = logging.getLogger(__name__)

MAX_ENCODINGS = 4
"""Films of different cameras, sizes, rates, qualities or codecs at a time; one thread makes them all."""

MAX_QUEUED = 15
"""Pictures that wait for one viewer; who is further behind goes on with the next complete one."""

KEY_PERIOD = 2.0
"""A complete picture comes at least this often [s]: what was lost on the way is made good by then."""

MIN_KEY_PERIOD = 0.25
"""And at most this often, however many viewers come and go [s]."""

Looking = Callable[[str], AbstractContextManager[NewestPicture]]
"""Has the camera of a topic work for as long as it is open."""


class FullError(Exception):
    """There are as many viewers or films as there may be; the text is one sentence."""


class FilmViewer:
    """What one viewer gets of a film: from a complete picture on, each one in its order or, after a gap, from the next
    complete one."""

    def __init__(self, film: _Film) -> None:
        self._film = film
        self._queued: deque[Encoded] = deque()
        self._waits_for_key = True
        self._ended = False
        self._came = asyncio.Event()

    @property
    def head(self) -> bytes:
        """What its file begins with; known with the first picture."""
        return self._film.encoder.head

    @property
    def parameters(self) -> bytes:
        """As of `VideoEncoder.parameters`."""
        return self._film.encoder.parameters

    def want_key(self) -> None:
        """It lost something on the way, and needs a complete picture to go on."""
        self._film.want_key()

    def offer(self, picture: Encoded) -> None:
        """The film goes on."""
        if self._waits_for_key and not picture.key:
            return
        self._waits_for_key = False
        self._queued.append(picture)
        if len(self._queued) > MAX_QUEUED:
            self._queued.clear()
            self._waits_for_key = True
            self._film.want_key()
        self._came.set()

    def end(self) -> None:
        """The film has ended."""
        self._ended = True
        self._came.set()

    async def next(self) -> Encoded | None:
        """The next picture; None when the film has ended."""
        while not self._queued:
            if self._ended:
                return None
            self._came.clear()
            await self._came.wait()
        return self._queued.popleft()


class SharedEncodings:
    """The films of one robot; belongs to who closes it."""

    def __init__(self, looking: Looking) -> None:
        self._looking = looking
        self._worker: ThreadPoolExecutor | None = None
        self._films: dict[View, _Film] = {}
        self._ending: set[asyncio.Task[None]] = set()

    @property
    def count(self) -> int:
        """Films that are being made, or come to their end."""
        return len(self._films) + len(self._ending)

    async def load(self, what: Callable[[], ModuleType] = library) -> ModuleType:
        """Load what makes film, or `what` is needed beside it, beside the loop. Raises NoVideo where it is not installed."""
        self._worker = self._worker or ThreadPoolExecutor(1, thread_name_prefix="film")
        return await asyncio.get_running_loop().run_in_executor(self._worker, what)

    def check(self, view: View) -> None:
        """Raises FullError when there are too many films that differ from `view`."""
        if view not in self._films and len(self._films) >= MAX_ENCODINGS:
            raise FullError(
                f"{MAX_ENCODINGS} films that differ in camera, width, quality, rate or codec are being made already; "
                "ask for one of those, or for mjpeg."
            )

    @contextmanager
    def watching(self, view: View) -> Iterator[FilmViewer]:
        """Somebody looks at a film; the last one who leaves ends it. Raises as `check` does, and NoVideo."""
        self.check(view)
        film = self._films.get(view)
        if film is None:
            self._worker = self._worker or ThreadPoolExecutor(1, thread_name_prefix="film")
            film = self._films[view] = _Film(view, self._looking, self._worker, self._forget)
        viewer = FilmViewer(film)
        film.viewers.add(viewer)
        film.want_key()
        try:
            yield viewer
        finally:
            film.viewers.discard(viewer)
            if not film.viewers:
                self._forget(film)
                film.task.cancel()

    def _forget(self, film: _Film) -> None:
        """Nobody looks at `film` any more, or it has ended."""
        if self._films.get(film.view) is film:
            del self._films[film.view]
            self._ending.add(film.task)
            film.task.add_done_callback(self._ending.discard)

    async def close(self) -> None:
        """End all films."""
        for film in list(self._films.values()):
            self._forget(film)
            film.task.cancel()
        await asyncio.gather(*self._ending, return_exceptions=True)
        worker, self._worker = self._worker, None
        if worker is not None:
            await asyncio.get_running_loop().run_in_executor(worker, int)  # all before it is done
            worker.shutdown()


class _Film:
    """One film and its viewers."""

    def __init__(
        self, view: View, looking: Looking, worker: ThreadPoolExecutor, on_end: Callable[[_Film], None]
    ) -> None:
        self.view = view
        self.viewers: set[FilmViewer] = set()
        self.encoder = VideoEncoder(view.codec, view.width, view.quality)
        self._looking, self._worker, self._on_end = looking, worker, on_end
        self._wants_key = True
        self._last_key = -math.inf
        self.task = asyncio.create_task(self._run())
        self.task.add_done_callback(self._close)

    def want_key(self) -> None:
        """A viewer cannot go on without a complete picture."""
        self._wants_key = True

    async def _run(self) -> None:
        try:
            with self._looking(self.view.topic) as newest:
                await self._make(newest)
        except TimeoutError:
            pass
        except Exception:  # who looks is told by the end of the film, and may ask for another one
            log.exception("The film %s failed", self.view)
        finally:
            for viewer in self.viewers:
                viewer.end()
            self._on_end(self)

    def _close(self, _: object) -> None:
        """It has ended, perhaps before it began; the encoder may still be in the thread's hands."""
        self._worker.submit(self.encoder.close)

    async def _make(self, newest: NewestPicture) -> None:
        loop, pace = asyncio.get_running_loop(), Pace(self.view.rate)
        while True:
            await pace.wait()
            picture = await newest.soon()
            key = self._key_is_due(loop.time())
            try:
                made = await loop.run_in_executor(
                    self._worker, self._encode, picture.data, picture.taken, key
                )
            except BridgeError:
                self._wants_key = self._wants_key or key
                continue  # one picture that cannot be read
            for each in made:
                for viewer in self.viewers:
                    viewer.offer(each)

    def _encode(self, picture: bytes, taken: float, key: bool) -> list[Encoded]:
        return self.encoder.encode(picture, taken, key=key)

    def _key_is_due(self, now: float) -> bool:
        since = now - self._last_key
        if since < KEY_PERIOD and not (self._wants_key and since >= MIN_KEY_PERIOD):
            return False
        self._wants_key, self._last_key = False, now
        return True
