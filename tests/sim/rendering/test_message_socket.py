"""Messages are taken and given whole, without waiting for the rest of one or for room."""

from __future__ import annotations

import socket
import struct

import pytest

from sim.rendering.message_socket import MAX_MESSAGE, MessageSocket, read_message, write_message

LONG = bytes(range(256)) * 8192


@pytest.fixture
def ends():
    ours, theirs = socket.socketpair()
    ours = MessageSocket(ours)
    with theirs:
        yield ours, theirs
    ours.close()


def test_a_message_is_taken_when_the_whole_of_it_is_there(ends):
    ours, theirs = ends
    framed = struct.pack("!I", 40_000) + LONG[:40_000] + struct.pack("!I", 2) + b"ab"
    for first, last in ((0, 3), (3, 4), (4, 20_000), (20_000, 40_003)):
        theirs.sendall(framed[first:last])
        assert ours.receive() is None
    theirs.sendall(framed[40_003:])
    assert [ours.receive() for _ in range(3)] == [LONG[:40_000], b"ab", None]


def test_what_finds_no_room_is_kept_and_goes_on_with_the_next_look(ends):
    ours, theirs = ends
    ours.send(LONG)
    assert not ours.is_free()
    with pytest.raises(RuntimeError, match="still on its way"):
        ours.send(b"more")
    got = b""
    while len(got) < len(LONG) + 4:
        got += theirs.recv(1 << 20)
        ours.is_free()
    assert ours.is_free()
    assert got == struct.pack("!I", len(LONG)) + LONG


def test_the_side_that_may_wait_speaks_the_same(ends):
    ours, theirs = ends
    with theirs.makefile("rb") as stream:
        ours.send(b"there")
        ours.send(b"")
        assert [read_message(stream), read_message(stream)] == [b"there", b""]
        write_message(theirs, b"and back")
        assert ours.receive() == b"and back"
        ours.close()
        with pytest.raises(EOFError):
            read_message(stream)


def test_an_end_is_told_also_within_a_message(ends):
    ours, theirs = ends
    theirs.sendall(struct.pack("!I", 10) + b"half")
    theirs.close()
    with pytest.raises(EOFError):
        ours.receive()
    with pytest.raises(OSError, match="Broken pipe"):
        ours.send(b"anything")


def test_a_length_beyond_any_picture_is_a_fault_and_nothing_is_kept_for_it(ends):
    ours, theirs = ends
    theirs.sendall(struct.pack("!I", MAX_MESSAGE + 1))
    with pytest.raises(OSError, match="16777217 bytes"):
        ours.receive()
    with pytest.raises(ValueError, match="16777217 bytes"):
        ours.send(bytes(MAX_MESSAGE + 1))
