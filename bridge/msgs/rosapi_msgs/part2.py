"""rosapi_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

from typing import ClassVar

from bridge.msgs.base import Msg

__all__ = [
    "ServicesForTypeResponse",
    "ServicesRequest",
    "ServicesResponse",
    "SetParamRequest",
    "SetParamResponse",
    "SubscribersRequest",
    "SubscribersResponse",
    "TopicTypeRequest",
    "TopicTypeResponse",
    "TopicsAndRawTypesRequest",
    "TopicsAndRawTypesResponse",
    "TopicsForTypeRequest",
    "TopicsForTypeResponse",
    "TopicsRequest",
    "TopicsResponse",
]


class ServicesForTypeResponse(Msg, frozen=True, gc=False):
    """What `ServicesForType` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ServicesForTypeResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string[]",)
    services: list[str] = []


class ServicesRequest(Msg, frozen=True, gc=False):
    """Ask which services there are."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ServicesRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class ServicesResponse(Msg, frozen=True, gc=False):
    """What `Services` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ServicesResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string[]",)
    services: list[str] = []


class SetParamRequest(Msg, frozen=True, gc=False):
    """Change a parameter."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/SetParamRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "string")
    name: str = ""
    value: str = ""
    """As JSON."""


class SetParamResponse(Msg, frozen=True, gc=False):
    """What `SetParam` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/SetParamResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string")
    successful: bool = False
    reason: str = ""
    """Why not."""


class SubscribersRequest(Msg, frozen=True, gc=False):
    """Ask who listens to a topic."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/SubscribersRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    topic: str = ""


class SubscribersResponse(Msg, frozen=True, gc=False):
    """What `Subscribers` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/SubscribersResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string[]",)
    subscribers: list[str] = []
    """Nodes."""


class TopicTypeRequest(Msg, frozen=True, gc=False):
    """Ask for a topic's type."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/TopicTypeRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    topic: str = ""


class TopicTypeResponse(Msg, frozen=True, gc=False):
    """What `TopicType` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/TopicTypeResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    type: str = ""


class TopicsAndRawTypesRequest(Msg, frozen=True, gc=False):
    """Ask which topics there are and how their types are defined."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/TopicsAndRawTypesRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class TopicsAndRawTypesResponse(Msg, frozen=True, gc=False):
    """What `TopicsAndRawTypes` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/TopicsAndRawTypesResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string[]", "string[]", "string[]")
    topics: list[str] = []
    types: list[str] = []
    """Of each."""
    typedefs_full_text: list[str] = []
    """The whole definition of each, as ROS text."""


class TopicsForTypeRequest(Msg, frozen=True, gc=False):
    """Ask which topics are of a type."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/TopicsForTypeRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    type: str = ""


class TopicsForTypeResponse(Msg, frozen=True, gc=False):
    """What `TopicsForType` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/TopicsForTypeResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string[]",)
    topics: list[str] = []


class TopicsRequest(Msg, frozen=True, gc=False):
    """Ask which topics there are."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/TopicsRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class TopicsResponse(Msg, frozen=True, gc=False):
    """What `Topics` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/TopicsResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string[]", "string[]")
    topics: list[str] = []
    types: list[str] = []
    """Of each."""
