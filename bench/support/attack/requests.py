"""Hostile HTTP requests of many kinds as they go over the wire. None presses STOP by POST: whoever does that gets it, by choice."""

from __future__ import annotations

import json
import random

__all__ = ["hostile_handshake", "hostile_request"]

METHODS = (
    "GET",
    "GET",
    "GET",
    "HEAD",
    "PUT",
    "DELETE",
    "OPTIONS",
    "PATCH",
    "TRACE",
    "CONNECT",
    "BREW",
    "get",
    "A" * 300,
)
POSTS = (
    "/login",
    "/pair",
    "/healthz",
    "/",
    "/snapshot/front.jpg",
    "/stop/release",
    "/control/acquire",
    "/cmd_vel",
    "/api/stop",
)
PATHS = (
    "/",
    "/healthz",
    "/snapshot/front.jpg?width=1&quality=999",
    "/snapshot/none.jpg",
    "/snapshot/..%2f..%2fetc%2fpasswd.jpg",
    "/stream/none.mjpeg?rate=nan",
    "/../../etc/passwd",
    "/%00",
    "/%ff%fe",
    "//healthz",
    "/stop",
    "/" + "a" * 8000,
    "*",
    "http://other.example/healthz",
    "/?" + "&".join(f"k{n}=v" for n in range(500)),
    "/healthz?name=<script>alert(1)</script>",
    "/login?token=secret",
    "/pair",
    "/people",
)
HOSTS = ("localhost", "127.0.0.1", "robot.attacker.example", "", "[::1", "a" * 300, "localhost:99999", "\x7f")
ORIGINS = (
    "null",
    "http://attacker.example",
    "https://localhost.attacker.example",
    "file://",
    "http://[x",
    "a" * 3000,
)
BODIES = (b"", b"{", b"[" * 10_000, b'{"token":"' + b"A" * 200 + b'"}', b"name=x&code=000000", b"\x00" * 5000)
HEADERS = (
    "Content-Length: 5\r\nContent-Length: 6",
    "Content-Length: -1",
    "Content-Length: 99999999999999",
    "Transfer-Encoding: chunked\r\nContent-Length: 3",
    "Transfer-Encoding: gzip, chunked",
    "Expect: 100-continue",
    "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: x",
    "Connection: Upgrade, HTTP2-Settings\r\nUpgrade: h2c",
    "Cookie: session=" + "z" * 2000,
    "Authorization: Bearer wrong",
    "Authorization: Basic AAAA",
    "Authorization: Bearer " + "é" * 50,
    "X-Forwarded-For: 127.0.0.1",
    "Range: bytes=0-,0-,0-",
    " folded: header",
    "NoColon",
    "X-Long: " + "b" * 20_000,
)
GARBAGE = (
    b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(200),  # the beginning of a TLS handshake
    b"\x16\x03\x01",
    b"\x00" * 300,
    b"GET\r\n\r\n",
    b"GET / HTTP/9.9\r\n\r\n",
    b"GET /\r\n",
    b"SSH-2.0-OpenSSH_9.6\r\n",
    b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
    b"\r\n" * 200,
)
KEY = "dGhlIHNhbXBsZSBub25jZQ=="
PLACES = ("/", "/camera/front", "/camera/none", "/../", "/%00", "/" + "p" * 9000, "/?token=secret")


def hostile_request(rng: random.Random) -> bytes:
    """One request, or what is none."""
    if rng.random() < 0.05:
        return rng.choice(GARBAGE)
    post = rng.random() < 0.3
    method, path = ("POST", rng.choice(POSTS)) if post else (rng.choice(METHODS), rng.choice(PATHS))
    lines = [f"{method} {path} HTTP/1.1"]
    lines += [f"Host: {rng.choice(HOSTS)}"] if rng.random() < 0.9 else []
    lines += [f"Origin: {rng.choice(ORIGINS)}"] if rng.random() < 0.4 else []
    lines += [rng.choice(HEADERS)] if rng.random() < 0.4 else []
    body = b""
    if post:
        body = (
            rng.choice(BODIES)
            if rng.random() < 0.8
            else json.dumps({"token": rng.randbytes(40).hex()}).encode()
        )
        kind = rng.choice(
            ("application/json", "application/x-www-form-urlencoded", "text/plain", "image/png", "\x01")
        )
        lines += [f"Content-Type: {kind}", f"Content-Length: {len(body)}"]
    return ("\r\n".join(lines) + "\r\n\r\n").encode("latin-1", "replace") + body


def hostile_handshake(rng: random.Random) -> bytes:
    """A WebSocket handshake that no server should agree to, or not more than half of one."""
    lines = [f"GET {rng.choice(PLACES)} HTTP/1.1", f"Host: {rng.choice(HOSTS)}"]
    lines += ["Upgrade: websocket", "Connection: Upgrade"] if rng.random() < 0.8 else ["Upgrade: h2c"]
    lines += [f"Sec-WebSocket-Key: {rng.choice((KEY, KEY, 'x', ''))}"]
    lines += [f"Sec-WebSocket-Version: {rng.choice(('13', '13', '8', 'x'))}"]
    lines += [f"Origin: {rng.choice(ORIGINS)}"] if rng.random() < 0.6 else []
    lines += [rng.choice(HEADERS)] if rng.random() < 0.4 else []
    text = ("\r\n".join(lines) + "\r\n\r\n").encode("latin-1", "replace")
    kind = rng.random()
    return rng.choice(GARBAGE) if kind < 0.2 else text[: rng.randrange(len(text))] if kind < 0.4 else text
