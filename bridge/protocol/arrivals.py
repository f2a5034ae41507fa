"""Operations of incoming frames: text, text in a binary frame, CBOR, several at once, in fragments, in a picture."""

from __future__ import annotations

from bridge.core.errors import ProtocolError
from bridge.protocol.fragments import Fragments
from bridge.protocol.names import wrong
from bridge.protocol.ops import BinaryPublish, Fragment, Op, Png
from bridge.protocol.png import MAX_FILTERED_BYTES, pixels
from bridge.protocol.wire import parse, parse_binary, parse_each

__all__ = ["Arrival", "Arrivals"]

Arrival = Op | BinaryPublish | ProtocolError
"""An operation, or the error of a faulty one."""
_PACKED = {Fragment, Png}


class Arrivals:
    """The incoming frames of one connection. Bounded: bytes of each frame, of all unfinished fragments, of a picture."""

    def __init__(
        self,
        limit_bytes: int,
        *,
        most: int = 4,
        lifetime: float = 10.0,
        filtered: int = MAX_FILTERED_BYTES,
        most_values: int | None = None,
    ) -> None:
        """`most` texts may be unfinished at a time, each for `lifetime` [s] after its last fragment.

        What takes long to read is bounded too: `filtered` are the bytes in filtered rows of a frame's pictures, `most_values`
        the values in a frame of CBOR, None for any.
        """
        self._limit = limit_bytes
        self._filtered = filtered
        self._most_values = most_values
        self._lost: list[ProtocolError] = []
        self._fragments = Fragments(limit_bytes, most, lifetime, given_up=self._lost.append)

    def receive(self, frame: str | bytes, now: float) -> list[Arrival]:
        """The operations in a frame that came at `now` [s], in order. Fragments and pictures give their content, once
        whole."""
        if len(frame) > self._limit:
            return [ProtocolError(f"A frame may have at most {self._limit} bytes, not {len(frame)}.")]
        if isinstance(frame, bytes) and frame[:1] > b"\x7f":  # a CBOR map begins so, JSON text never does
            return [_binary(frame, self._most_values)]
        try:
            op = parse(frame)
        except ProtocolError as error:
            found = parse_each(frame, error)
        else:
            if type(op) not in _PACKED and not self._fragments:
                return [op]
            found = [op]
        self._fragments.expire(now)
        return _Unpacking(self._limit, self._filtered, self._fragments, self._lost, now).unpacked(found)

    def expire(self, now: float) -> list[ProtocolError]:
        """The errors of the texts that are given up at `now` [s], unfinished for too long; to be called every second
        or so."""
        self._fragments.expire(now)
        lost, self._lost[:] = list(self._lost), []
        return lost


class _Unpacking:
    """One frame being unpacked. A picture may be in fragments, and nothing else within another."""

    def __init__(
        self, limit: int, filtered: int, fragments: Fragments, lost: list[ProtocolError], now: float
    ) -> None:
        self._left = limit
        self._filtered = filtered
        self._fragments = fragments
        self._lost = lost
        self._now = now

    def unpacked(self, found: list[Op | ProtocolError], within: type[Op] | None = None) -> list[Arrival]:
        arrivals: list[Arrival] = []
        for each in found:
            try:
                if isinstance(each, Fragment):
                    arrivals += self._fragment(each, within)
                elif isinstance(each, Png):
                    arrivals += self._picture(each, within)
                else:
                    arrivals.append(each)
            except ProtocolError as error:
                arrivals.append(error)
            arrivals += self._lost
            self._lost.clear()
        return arrivals

    def _fragment(self, op: Fragment, within: type[Op] | None) -> list[Arrival]:
        if within is not None:
            raise wrong(op, "A fragment cannot stand in a fragment or a png.")
        text = self._fragments.add(op, self._now)
        return [] if text is None else self.unpacked(parse_each(text), Fragment)

    def _picture(self, op: Png, within: type[Op] | None) -> list[Arrival]:
        if within is Png:
            raise wrong(op, "A png cannot stand in a png.")
        text, filtered = pixels(op, self._left, self._filtered)
        self._left -= len(text)
        self._filtered -= filtered
        return self.unpacked(parse_each(text), Png)


def _binary(frame: bytes, most_values: int | None) -> BinaryPublish | ProtocolError:
    try:
        return parse_binary(frame, most_values)
    except ProtocolError as error:
        return error
