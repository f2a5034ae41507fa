"""Smaller pictures: the same JPEG with fewer columns or less quality, made in one worker thread."""

from __future__ import annotations

import asyncio
import io
from collections import OrderedDict, deque
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from PIL import Image

from bridge.core.camera_frames import picture_size
from bridge.core.errors import BridgeError

__all__ = ["LEVELS", "PictureScaler", "Superseded", "smaller"]

LEVELS = ((1.0, 45), (0.5, 50), (0.375, 35))
"""Levels 1 to 3 of a camera's own socket: part of the original's columns, JPEG quality. In bytes, about a half each."""

DEFAULT_QUALITY = 80
"""JPEG quality where none is asked for."""

MAX_WAITING = 4
"""Pictures of those who watch that may wait for the worker; a further one takes the place of the oldest."""

MAX_CACHED = 8
"""Pictures kept for others who want the same."""


class Superseded(BridgeError):
    """Newer pictures were wanted before this one could be made."""


@dataclass(slots=True, eq=False)
class _Wish:
    """What somebody wants of one picture."""

    jpeg: bytes
    width: float | None
    quality: int
    form: str
    result: asyncio.Future[bytes]
    patient: bool = False
    """The asker asks once and waits."""


class PictureScaler:
    """Makes pictures smaller, each once; belongs to the event loop that calls it, and to who closes it."""

    def __init__(self) -> None:
        self._worker = ThreadPoolExecutor(1, thread_name_prefix="pictures")
        self._waiting: deque[_Wish] = deque()
        self._kept: OrderedDict[tuple[int, float | None, int, str], _Wish] = OrderedDict()
        self._busy: asyncio.Task[None] | None = None

    def shrink(self, jpeg: bytes, level: int) -> asyncio.Future[bytes]:
        """`jpeg` at `level`, 1 to 3, as `bridge.server.server.BridgeServer` wants it. Fails as `make` does."""
        part, quality = LEVELS[level - 1]
        return self.make(jpeg, part if part < 1.0 else None, quality)

    def make(
        self,
        jpeg: bytes,
        width: float | None = None,
        quality: int | None = None,
        *,
        form: str = "JPEG",
        patient: bool = False,
    ) -> asyncio.Future[bytes]:
        """`jpeg` with at most `width` columns [px], or that part of them when below 1, at `quality`, 1 to 95; as a file of
        `form`, JPEG or PNG.

        Askers that want the same of the same object share it. Fails with BridgeError for what is no JPEG file, and with
        Superseded when too much newer work came before it was begun, which a `patient` asker's is never.
        """
        key = (id(jpeg), width, DEFAULT_QUALITY if quality is None else quality, form)
        wish = self._kept.get(key)
        if wish is None or wish.result.cancelled():
            result = asyncio.get_running_loop().create_future()
            wish = _Wish(jpeg, width, key[2], form, result, patient)
            wish.result.add_done_callback(_look)
            self._kept[key] = wish
            while len(self._kept) > MAX_CACHED:
                self._kept.popitem(last=False)
            self._add(wish)
        wish.patient = wish.patient or patient
        return asyncio.shield(wish.result)

    async def close(self) -> None:
        """End the worker; what still waits is cancelled."""
        while self._waiting:
            self._waiting.popleft().result.cancel()
        if self._busy is not None:
            await asyncio.wait({self._busy})
        self._kept.clear()
        self._worker.shutdown()

    def _add(self, wish: _Wish) -> None:
        watched = [waiting for waiting in self._waiting if not waiting.patient]
        if len(watched) >= MAX_WAITING and not wish.patient:
            self._pass_over(watched[0])
        self._waiting.append(wish)
        if self._busy is None:
            self._busy = asyncio.create_task(self._work())

    def _pass_over(self, wish: _Wish) -> None:
        self._waiting.remove(wish)
        self._kept.pop((id(wish.jpeg), wish.width, wish.quality, wish.form), None)
        wish.result.set_exception(Superseded("Newer pictures came first."))

    async def _work(self) -> None:
        loop = asyncio.get_running_loop()
        while self._waiting:
            wish = self._waiting.popleft()
            work = loop.run_in_executor(self._worker, smaller, wish.jpeg, wish.width, wish.quality, wish.form)
            try:
                made = await work
            except Exception as fault:  # noqa: BLE001 - who waits for the picture gets the fault, of any kind
                wish.result.set_exception(fault)
            else:
                wish.result.set_result(made)
        self._busy = None


def smaller(jpeg: bytes, width: float | None, quality: int, form: str = "JPEG") -> bytes:
    """`jpeg` as `PictureScaler.make` describes, made at once; never wider than it was."""
    if jpeg.startswith(b"\xff\xd8\xff"):  # what is no JPEG file at all is said below
        picture_size(jpeg)
    try:
        with Image.open(io.BytesIO(jpeg), formats=("JPEG",)) as image:
            columns, rows = image.size
            wanted = columns if width is None else round(width * columns if width < 1.0 else width)
            size = max(1, min(wanted, columns)), max(1, round(rows * min(1.0, wanted / columns)))
            image.draft(None, size)
            small = image.resize(size, Image.Resampling.BOX) if image.size != size else image
            file = io.BytesIO()
            options = {"quality": quality} if form == "JPEG" else {"compress_level": 1}  # more costs long
            small.save(file, form, **options)
            return file.getvalue()
    except (OSError, SyntaxError, ValueError) as fault:
        raise BridgeError(
            f"The picture cannot be made smaller: it is no whole JPEG file ({fault})."
        ) from fault


def _look(result: asyncio.Future[bytes]) -> None:
    """A fault that is no longer waited for needs no complaint."""
    if not result.cancelled():
        result.exception()
