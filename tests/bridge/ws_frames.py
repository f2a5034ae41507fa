"""What a server wrote, as a client's WebSocket library reads it."""

from __future__ import annotations

from websockets.frames import Frame
from websockets.protocol import CLIENT, Protocol, State

__all__ = ["frames"]


def frames(data: bytes) -> list[Frame]:
    """The WebSocket frames in `data`; none may be incomplete."""
    library = Protocol(CLIENT, state=State.OPEN)
    library.receive_data(data)
    return [event for event in library.events_received() if isinstance(event, Frame)]
