"""Content in blocks, as RFC 7959 has it: what a client sends in several requests, and what it reads in several."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Hashable
from typing import Any, NamedTuple

from aiocoap.message import Message
from aiocoap.numbers.codes import Code as CoapCode

from robotside.gateways.coap.requests import MAX_BLOCK, Body, Failure
from robotside.gateways.plain.strict_json import MAX_INPUT

__all__ = ["BlocksIn", "BlocksOut"]

MAX_UPLOADS = 16
"""Contents that are being sent in blocks at a time; of more, the one that was begun first is dropped."""
UPLOAD_TIMEOUT = 30.0
"""A block of a content comes so soon after the one before [s]."""
MAX_BODIES = 32
"""Contents that are kept for who reads them in blocks."""
MAX_BODY_BYTES = 4_194_304
"""Of all of them."""
BODY_TIMEOUT = 30.0
"""So long after it was read last a content is kept [s]."""
_MAX_EXPONENT = 6


class _Upload(NamedTuple):
    content: bytes
    at: float


class BlocksIn:
    """Contents that clients are sending."""

    def __init__(self) -> None:
        self._uploads: OrderedDict[Hashable, _Upload] = OrderedDict()

    def take(self, request: Any, key: Hashable, now: float) -> bytes:
        """The whole content of a request; raises Failure, which is CoAP's 2.31 while there is more to come."""
        block, payload = request.opt.block1, bytes(request.payload)
        if block is None:
            if len(payload) > MAX_BLOCK:
                said = f"A message has at most {MAX_BLOCK} bytes, not {len(payload)}: send it in blocks."
                raise Failure(CoapCode.REQUEST_ENTITY_TOO_LARGE, said, size1=MAX_BLOCK)
            return payload
        number, more, exponent = block
        size = 16 << min(exponent, _MAX_EXPONENT)
        before = _Upload(b"", now) if number == 0 else self._uploads.pop(key, None)
        if before is None or now - before.at > UPLOAD_TIMEOUT or len(before.content) != number * size:
            raise Failure(
                CoapCode.REQUEST_ENTITY_INCOMPLETE, f"Block {number} does not follow what came before."
            )
        if len(payload) > size or (more and len(payload) < size):
            raise Failure(CoapCode.BAD_REQUEST, f"A block of {size} bytes has {len(payload)}.")
        content = before.content + payload
        if len(content) > MAX_INPUT:
            said = f"A message has at most {MAX_INPUT} bytes."
            raise Failure(CoapCode.REQUEST_ENTITY_TOO_LARGE, said, size1=MAX_INPUT)
        if not more:
            return content
        self._uploads[key] = _Upload(content, now)
        self._uploads.move_to_end(key)
        while len(self._uploads) > MAX_UPLOADS:
            self._uploads.popitem(last=False)
        raise Failure(CoapCode.CONTINUE, "", block1=(number, True, min(exponent, _MAX_EXPONENT)))

    def clear(self) -> None:
        """Nobody sends any more."""
        self._uploads.clear()


class BlocksOut:
    """Contents that clients are reading: all blocks are of the one that they began with."""

    def __init__(self) -> None:
        self._bodies: OrderedDict[Hashable, tuple[Body, float]] = OrderedDict()

    def kept(self, request: Any, key: Hashable, now: float) -> Body | None:
        """The content of which `request` reads a block that is not the first; None when it is not kept."""
        block = request.opt.block2
        if block is None or block.block_number == 0:
            return None
        body, at = self._bodies.get(key, (None, now))
        return body if now - at <= BODY_TIMEOUT else None

    def answer(
        self,
        request: Any,
        key: Hashable,
        body: Body,
        now: float,
        code: CoapCode = CoapCode.CONTENT,
        **words: Any,
    ) -> Any:
        """The answer of `code` with the block that is asked for; `words` are options. Raises Failure for one beyond the end."""
        number, _, exponent = request.opt.block2 or (0, False, _MAX_EXPONENT)
        size = 16 << min(exponent, _MAX_EXPONENT)
        options = {"content_format": body.format, "etag": body.tag} | words
        if len(body.payload) <= min(size, MAX_BLOCK) and number == 0:
            return Message(code=code, payload=body.payload, **options)
        part = body.payload[number * size : (number + 1) * size]
        if not part:
            raise Failure(
                CoapCode.BAD_OPTION, f"There is no block {number}: it has {len(body.payload)} bytes."
            )
        more = (number + 1) * size < len(body.payload)
        self._keep(key, body, now)
        block = (number, more, min(exponent, _MAX_EXPONENT))
        return Message(code=code, payload=part, block2=block, size2=len(body.payload), **options)

    def clear(self) -> None:
        """Nobody reads any more."""
        self._bodies.clear()

    def _keep(self, key: Hashable, body: Body, now: float) -> None:
        self._bodies[key] = body, now
        self._bodies.move_to_end(key)
        while (
            len(self._bodies) > MAX_BODIES
            or sum(len(each.payload) for each, _ in self._bodies.values()) > MAX_BODY_BYTES
        ) and len(self._bodies) > 1:
            self._bodies.popitem(last=False)
