"""A robot proves its key before it hears one byte, and knows the client by its token."""

from __future__ import annotations

import asyncio
import contextlib
import http
import math
import ssl
from contextlib import asynccontextmanager

import pytest
from websockets.asyncio.server import serve

from bridge.client import camera_stream
from bridge.client.camera_stream import CameraStream
from bridge.client.client import Phase
from bridge.client.connection import open_connection
from bridge.client.credentials import Credentials
from bridge.core.address import LinkLost, NotAccepted, NotProtected, WrongKey
from bridge.core.link_state import LinkFault
from tests.bridge.certificates import served
from tests.bridge.wires import Record, link

TOKEN = "anna.0123456789"


class Patient:
    """A TLS server that notes what it hears after the handshake of TLS, until the connection is cut or something came."""

    def __init__(self, name: str) -> None:
        self.context, self.fingerprint = served(name)
        self.heard = Record()

    async def _serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        coming, going, heard = ssl.MemoryBIO(), ssl.MemoryBIO(), b""
        spoken = self.context.wrap_bio(coming, going, server_side=True)
        steps = [spoken.do_handshake]
        while True:
            with contextlib.suppress(ssl.SSLWantReadError):
                if steps:
                    steps[0]()
                    steps.clear()
                heard = spoken.read(4096)
            writer.write(going.read())
            if heard:
                break
            try:
                raw = await reader.read(4096)
            except OSError:
                break
            if not raw:
                break
            coming.write(raw)
        self.heard(heard)
        writer.close()

    @asynccontextmanager
    async def listening(self):
        async with await asyncio.start_server(self._serve, "127.0.0.1", 0) as made:
            yield f"127.0.0.1:{made.sockets[0].getsockname()[1]}"


@asynccontextmanager
async def robot(name: str = "patrol", answer=None):
    """A WebSocket server with a certificate, and what it was told of who comes."""
    context, fingerprint = served(name)
    tokens = Record()

    def judge(connection, request):
        tokens(request.headers.get("Authorization"))
        return answer(connection) if answer else None

    async def nothing(ws):
        await ws.wait_closed()

    async with serve(
        nothing, "127.0.0.1", 0, ssl=context, process_request=judge, close_timeout=0.1
    ) as listening:
        yield f"wss://127.0.0.1:{listening.sockets[0].getsockname()[1]}", fingerprint, tokens


async def test_another_certificate_gets_not_one_byte():
    other = Patient("other")
    expected = Credentials(served("patrol")[1], TOKEN, "Patrol-1")
    async with other.listening() as place:
        with pytest.raises(WrongKey) as raised:
            await open_connection(f"wss://{place}", 5.0, credentials=expected)
        assert str(raised.value) == f"Another robot answers at {place}: its key is not the one of Patrol-1."
        assert await other.heard.reach(1) == [b""]


async def test_the_same_server_hears_a_client_that_expects_its_certificate():
    """Else the test above would show nothing."""
    other = Patient("other")
    async with other.listening() as place:
        with pytest.raises(LinkLost):
            await open_connection(f"wss://{place}", 60.0, credentials=Credentials(other.fingerprint, TOKEN))
        (heard,) = await other.heard.reach(1)
        assert f"Authorization: Bearer {TOKEN}\r\n".encode() in heard


async def test_the_expected_certificate_is_told_the_token():
    async with robot() as (url, fingerprint, tokens):
        made = await open_connection(url, 5.0, credentials=Credentials(fingerprint, TOKEN))
        assert tokens == [f"Bearer {TOKEN}"]
        assert made.fingerprint == fingerprint
        assert made.send("{}")
        assert not made.full
        await made.close()


async def test_without_a_pin_it_connects_and_tells_which_key_it_saw():
    async with robot() as (url, fingerprint, tokens):
        made = await open_connection(url, 5.0)
        assert (made.fingerprint, tokens) == (fingerprint, [None])
        await made.close()


async def test_a_pin_without_a_token_sends_none():
    """Pairing: the link's fingerprint is known and the token is not there yet."""
    async with robot() as (url, fingerprint, tokens):
        await (await open_connection(url, 5.0, credentials=Credentials(fingerprint))).close()
        assert tokens == [None]


@pytest.mark.parametrize("scheme", ["ws", "WS", "wss"])
async def test_a_token_never_leaves_without_tls_whatever_the_address_says(scheme):
    async with robot() as (url, fingerprint, tokens):
        made = await open_connection(
            url.replace("wss", scheme), 5.0, credentials=Credentials(fingerprint, TOKEN)
        )
        assert (made.fingerprint, tokens) == (fingerprint, [f"Bearer {TOKEN}"])
        await made.close()


async def test_a_robot_that_wants_tls_says_so():
    async def refuse(connection, _):
        return connection.respond(http.HTTPStatus.UPGRADE_REQUIRED, "Connect by wss:// and pair.")

    async def nothing(ws):
        await ws.wait_closed()

    async with serve(nothing, "127.0.0.1", 0, process_request=refuse, close_timeout=0.1) as listening:
        place = f"127.0.0.1:{listening.sockets[0].getsockname()[1]}"
        with pytest.raises(NotProtected) as raised:
            await open_connection(f"ws://{place}", 5.0)
        assert str(raised.value) == f"{place} refuses: Connect by wss:// and pair."


async def test_a_redirect_is_not_followed():
    """It would take the token to another address."""

    def redirect(connection):
        response = connection.respond(http.HTTPStatus.FOUND, "")
        response.headers["Location"] = "wss://127.0.0.1:9/elsewhere"
        return response

    async with robot(answer=redirect) as (url, fingerprint, _):
        with pytest.raises(LinkLost, match=r"no robot \(HTTP 302\)"):
            await open_connection(url, 5.0, credentials=Credentials(fingerprint, TOKEN))


async def test_a_token_that_is_not_known_any_more_is_one_sentence():
    async with robot(answer=lambda made: made.respond(http.HTTPStatus.UNAUTHORIZED, "")) as (url, key, _):
        with pytest.raises(NotAccepted) as raised:
            await open_connection(url, 5.0, credentials=Credentials(key, TOKEN))
        assert str(raised.value) == "This robot does not know this handheld any more; pair again."


def refuse_keys(connection):
    """A robot that knows nobody's key and lets strangers in."""
    return (
        connection.respond(http.HTTPStatus.UNAUTHORIZED, "")
        if "Authorization" in connection.request.headers
        else None
    )


async def test_a_client_may_go_on_as_a_stranger_where_its_token_is_not_known_any_more():
    """And only to the robot that it expects."""
    async with robot(answer=refuse_keys) as (url, key, tokens):
        async with link(url, credentials=Credentials(key, TOKEN), even_unknown=True):
            assert await tokens.reach(2) == [f"Bearer {TOKEN}", None]
        tokens.clear()
        other = Credentials(served("other")[1], TOKEN)
        async with link(url, credentials=other, even_unknown=True) as made:
            assert "Another robot answers" in await made.sentence(Phase.WAITING)
        assert tokens == []


async def test_a_client_goes_on_as_a_stranger_only_when_it_is_told_to():
    async with (
        robot(answer=refuse_keys) as (url, key, tokens),
        link(url, credentials=Credentials(key, TOKEN)),
    ):
        assert set(await tokens.reach(4)) == {f"Bearer {TOKEN}"}


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ("Pair this handheld first.\nAnd more.", "refuses: Pair this handheld first."),
        ("x" * 5000, f"refuses: {'x' * 200}"),
        ("\x1b[31mred", r"is no robot (HTTP 403)."),
        ("", r"is no robot (HTTP 403)."),
    ],
)
async def test_a_refusal_is_told_in_the_server_s_own_words_and_bounded(words, sentence):
    async with robot(answer=lambda made: made.respond(http.HTTPStatus.FORBIDDEN, words)) as (url, _, _):
        with pytest.raises(LinkLost) as raised:
            await open_connection(url, 5.0)
        assert str(raised.value).endswith(sentence)


async def test_a_server_without_tls_is_one_sentence():
    async def say(reader, writer):
        await reader.read(10)
        writer.write(b"HTTP/1.1 400 Bad Request\r\n\r\n")
        writer.close()

    async with await asyncio.start_server(say, "127.0.0.1", 0) as listening:
        place = f"127.0.0.1:{listening.sockets[0].getsockname()[1]}"
        with pytest.raises(LinkLost) as raised:
            await open_connection(f"wss://{place}", 5.0)
        assert str(raised.value) == f"What answers at {place} is no robot (it does not speak TLS)."


async def test_after_another_key_the_client_waits_the_longest_and_says_why():
    """No storm of attempts; the robot itself may come back to its address."""
    other = Patient("other")
    async with (
        other.listening() as place,
        link(
            f"wss://{place}", credentials=Credentials(served("patrol")[1], TOKEN), backoff=(0.01, 60.0)
        ) as made,
    ):
        states = await made.states.until(lambda seen: any(state.phase is Phase.WAITING for state in seen))
        assert states[-1].fault is LinkFault.WRONG_KEY
        assert states[-1].retry_in >= 0.8 * 60.0


async def test_a_client_and_a_camera_take_credentials():
    async with robot() as (url, fingerprint, tokens):
        credentials = Credentials(fingerprint, TOKEN)
        stream = CameraStream(f"{url}/camera/front", lambda *_: None, credentials=credentials)
        watching = asyncio.create_task(stream.run())
        async with link(url, credentials=credentials):
            assert await tokens.reach(2) == [f"Bearer {TOKEN}"] * 2
        await stream.close()
        await watching


async def test_a_camera_does_not_storm_another_key(monkeypatch):
    waits = Record()

    async def wait(seconds):
        waits(seconds)
        await asyncio.get_running_loop().create_future()

    other = Patient("other")
    async with other.listening() as place:
        expected = Credentials(served("patrol")[1], TOKEN)
        stream = CameraStream(
            f"wss://{place}/camera/x", lambda *_: None, credentials=expected, backoff=(0.01, 60.0)
        )
        with monkeypatch.context() as patched:
            patched.setattr(camera_stream.asyncio, "sleep", wait)
            watching = asyncio.create_task(stream.run())
            (seconds,) = await waits.reach(1)
        assert seconds >= 48.0
        assert math.isfinite(seconds)
        await stream.close()
        await watching
