"""The camera by WebRTC, as WHEP has it: a viewer posts its offer, gets an answer, and deletes what it got when it leaves.

The pictures are those of the shared films: a viewer costs no encoding of its own.
"""

from __future__ import annotations

import asyncio
import contextlib
import secrets
from collections.abc import Callable
from fractions import Fraction
from types import ModuleType
from typing import Any

from bridge.core.errors import BridgeError
from robotside.core.installing import how_to_install
from robotside.gateways.video.delays import Delays
from robotside.gateways.video.shared_encodings import FilmViewer, FullError, SharedEncodings
from robotside.gateways.video.video_encoder import TIME_SCALE, Encoded, NoVideo, library
from robotside.gateways.video.views import View

__all__ = ["CONNECT_TIMEOUT", "MAX_OFFER", "MAX_SESSIONS", "BadOffer", "WhepSessions"]

MAX_SESSIONS = 8
"""Viewers at a time."""

MAX_OFFER = 65_536
"""Bytes of an offer."""

CONNECT_TIMEOUT = 15.0
"""Who has not connected for this long after its answer is forgotten [s]."""

MAX_CANDIDATES = 32
"""Of an offer; what comes after them is left out."""

ANSWER_TIMEOUT = 10.0
"""How long an answer may take [s]."""

_MIME_TYPES = {"h264": "video/H264", "vp8": "video/VP8"}


class BadOffer(BridgeError):
    """An offer that cannot be answered; the text is one sentence."""


class WhepSessions:
    """The viewers of one robot's cameras by WebRTC; belongs to who closes it."""

    def __init__(self, films: SharedEncodings, delays: Delays) -> None:
        self._films, self._delays = films, delays
        self._sessions: dict[str, _Session] = {}
        self._tasks: set[asyncio.Task[None]] = set()

    @property
    def count(self) -> int:
        """Viewers that are there, come or go."""
        return len(self._tasks)

    async def open(
        self, view: View, offer: str, address: str, may_watch: Callable[[], bool], on_end: Callable[[], None]
    ) -> tuple[str, str, Callable[[], None]]:
        """Answer the `offer` of who asks from `address`: the session's name, the answer, and what ends it.

        It goes on while `may_watch()` and until its viewer is gone; `on_end` is called then. Raises BadOffer, FullError and NoVideo.
        """
        aiortc = await self._films.load(_library)
        self._films.check(view)
        if len(self._tasks) >= MAX_SESSIONS:
            raise FullError(f"{MAX_SESSIONS} look at the camera by WebRTC already; close one of them.")
        session = _Session(aiortc, self._films, view, self._delays, may_watch)
        task = asyncio.create_task(session.run())
        self._tasks.add(task)
        name = secrets.token_urlsafe(16)

        def ended(_: object) -> None:
            self._tasks.discard(task)
            self._sessions.pop(name, None)
            on_end()

        try:
            answer = await session.answer(_from(address, offer))
        except BaseException:
            task.add_done_callback(self._tasks.discard)
            session.end()
            raise
        self._sessions[name] = session
        task.add_done_callback(ended)
        return name, answer, session.end

    def end(self, name: str) -> bool:
        """End the session of that name; False when there is none."""
        session = self._sessions.get(name)
        if session is not None:
            session.end()
        return session is not None

    async def close(self) -> None:
        """End all sessions."""
        for session in list(self._sessions.values()):
            session.end()
        await asyncio.gather(*self._tasks, return_exceptions=True)


class _Session:
    """One viewer. Fits what aiortc sends as a track."""

    kind = "video"

    def __init__(
        self, aiortc: Any, films: SharedEncodings, view: View, delays: Delays, may_watch: Callable[[], bool]
    ) -> None:
        self.id = secrets.token_hex(8)
        self._aiortc, self._films, self._view = aiortc, films, view
        self._delays, self._may_watch = delays, may_watch
        self._peer = aiortc.RTCPeerConnection(aiortc.RTCConfiguration(iceServers=[]))
        self._peer.on("connectionstatechange", self._on_change)
        self._answered, self._connected, self._ended = asyncio.Event(), asyncio.Event(), asyncio.Event()
        self._film: asyncio.Future[FilmViewer] = asyncio.get_running_loop().create_future()

    def end(self) -> None:
        """It is over."""
        for event in (self._ended, self._connected, self._answered):
            event.set()

    async def answer(self, offer: str) -> str:
        """The answer to an offer. Raises BadOffer."""
        try:
            async with asyncio.timeout(ANSWER_TIMEOUT):
                return await self._answer(offer)
        except BadOffer:
            raise
        except Exception as fault:
            said = str(fault).partition("\n")[0][:120] or type(fault).__name__
            raise BadOffer(f"The offer cannot be answered: {said}.") from fault

    async def _answer(self, offer: str) -> str:
        known = self._aiortc.RTCRtpSender.getCapabilities("video").codecs
        video = self._peer.addTransceiver("video", direction="sendonly")
        video.setCodecPreferences([each for each in known if each.mimeType == _MIME_TYPES[self._view.codec]])
        video.sender.replaceTrack(self)
        # aiortc tells this to an encoder of its own, and has no public way to tell others
        setattr(video.sender, "_send_keyframe", self._want_key)  # noqa: B010
        await self._peer.setRemoteDescription(self._aiortc.RTCSessionDescription(offer, "offer"))
        videos = [each for each in self._peer.getTransceivers() if each.kind == "video" and each.mid]
        if videos != [video]:
            raise BadOffer(f"An offer has one video that it wants to receive, not {len(videos)}.")
        await self._peer.setLocalDescription(await self._peer.createAnswer())
        self._answered.set()
        answer: str = self._peer.localDescription.sdp
        return answer

    async def run(self) -> None:
        """Serve until it is over."""
        try:
            await self._answered.wait()
            async with asyncio.timeout(CONNECT_TIMEOUT):
                await self._connected.wait()
            if not self._ended.is_set():
                with self._films.watching(self._view) as film:
                    self._film.set_result(film)
                    await self._ended.wait()
        except (TimeoutError, FullError):
            pass
        finally:
            self._film.cancel()
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(ANSWER_TIMEOUT):
                    await self._peer.close()

    async def recv(self) -> Any:
        """The next picture, as the sender wants it."""
        film = await asyncio.shield(self._film)
        picture = await film.next()
        if picture is None or not self._may_watch():
            self.end()
            raise self._aiortc.mediastreams.MediaStreamError
        packet = library().Packet(_stream(picture, film.parameters) if film.parameters else picture.data)
        packet.pts, packet.time_base = picture.at, Fraction(1, TIME_SCALE)
        self._delays.note(self._view.topic, "whep", asyncio.get_running_loop().time() - picture.taken)
        return packet

    def _want_key(self) -> None:
        """The viewer has lost something."""
        if self._film.done() and not self._film.cancelled():
            self._film.result().want_key()

    def stop(self) -> None:
        """The sender has ended."""
        self.end()

    def _on_change(self) -> None:
        if self._peer.connectionState == "connected":
            self._connected.set()
        elif self._peer.connectionState in {"failed", "closed"}:
            self.end()


def _library() -> ModuleType:
    """aiortc; NoVideo, in one sentence, where it is not installed."""
    library()
    try:
        import aiortc
        import aiortc.mediastreams
    except ImportError as missing:
        raise NoVideo(
            f"This robot speaks no WebRTC: aiortc is not installed; {how_to_install('video')} brings it."
        ) from missing
    return aiortc


def _from(address: str, offer: str) -> str:
    """The offer with all its candidates at the asker's own address: the robot knocks nowhere else, and browsers hide theirs.

    Where that is wrong, or there is none, the asker's own knock at the robot tells.
    """
    lines, found = [], 0
    for line in offer.splitlines():
        words = line.split()
        if not line.startswith("a=candidate:"):
            lines.append(line)
        elif len(words) > 5 and words[2].lower() == "udp" and found < MAX_CANDIDATES:
            lines.append(f"{' '.join(words[:4])} {address} {words[5]} typ host")
            found += 1
    if not found:
        lines.append(f"a=candidate:1 1 udp 1 {address} 9 typ host")
    return "".join(f"{line}\r\n" for line in lines)


def _stream(picture: Encoded, parameters: bytes) -> bytes:
    """H.264 with each unit behind a start code, and with the parameter sets before a complete picture."""
    parts, at = [parameters] if picture.key else [], 0
    while at < len(picture.data):
        end = at + 4 + int.from_bytes(picture.data[at : at + 4], "big")
        parts += b"\0\0\0\1", picture.data[at + 4 : end]
        at = end
    return b"".join(parts)
