"""rosapi_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

from typing import ClassVar

from msgspec import field

from bridge.msgs.arrays import Int32Array
from bridge.msgs.base import Msg, uint8
from bridge.msgs.builtin_interfaces import Time

__all__ = [
    "ActionFeedbackDetailsRequest",
    "ActionFeedbackDetailsResponse",
    "ActionGoalDetailsRequest",
    "ActionGoalDetailsResponse",
    "ActionResultDetailsRequest",
    "ActionResultDetailsResponse",
    "ActionTypeRequest",
    "ActionTypeResponse",
    "DeleteParamRequest",
    "DeleteParamResponse",
    "GetActionServersRequest",
    "GetActionServersResponse",
    "GetParamNamesRequest",
    "GetParamNamesResponse",
    "GetParamRequest",
    "GetParamResponse",
    "GetROSVersionRequest",
    "GetROSVersionResponse",
    "GetTimeRequest",
    "GetTimeResponse",
    "HasParamRequest",
    "HasParamResponse",
    "InterfacesRequest",
    "InterfacesResponse",
    "MessageDetailsRequest",
    "MessageDetailsResponse",
    "NodeDetailsRequest",
    "NodeDetailsResponse",
    "NodesRequest",
    "NodesResponse",
    "PublishersRequest",
    "PublishersResponse",
    "SearchParamRequest",
    "SearchParamResponse",
    "ServiceHostRequest",
    "ServiceHostResponse",
    "ServiceNodeRequest",
    "ServiceNodeResponse",
    "ServiceProvidersRequest",
    "ServiceProvidersResponse",
    "ServiceRequestDetailsRequest",
    "ServiceRequestDetailsResponse",
    "ServiceResponseDetailsRequest",
    "ServiceResponseDetailsResponse",
    "ServiceTypeRequest",
    "ServiceTypeResponse",
    "ServicesForTypeRequest",
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
    "TypeDef",
]


class ActionFeedbackDetailsRequest(Msg, frozen=True, gc=False):
    """Ask what an action's feedback is made of."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ActionFeedbackDetailsRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    type: str = ""


class TypeDef(Msg, frozen=True, gc=False):
    """Description of a type; one entry per field, and one per constant."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/TypeDef"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "string",
        "string[]",
        "string[]",
        "int32[]",
        "string[]",
        "string[]",
        "string[]",
    )
    type: str = ""
    fieldnames: list[str] = []
    fieldtypes: list[str] = []
    """Of one element."""
    fieldarraylen: Int32Array = field(default_factory=Int32Array)
    """-1 no array, 0 any length, else the length."""
    examples: list[str] = []
    constnames: list[str] = []
    constvalues: list[str] = []


class ActionFeedbackDetailsResponse(Msg, frozen=True, gc=False):
    """What `ActionFeedbackDetails` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ActionFeedbackDetailsResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("rosapi_msgs/TypeDef[]",)
    typedefs: list[TypeDef] = []
    """The feedback first."""


class ActionGoalDetailsRequest(Msg, frozen=True, gc=False):
    """Ask what an action's goal is made of."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ActionGoalDetailsRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    type: str = ""


class ActionGoalDetailsResponse(Msg, frozen=True, gc=False):
    """What `ActionGoalDetails` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ActionGoalDetailsResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("rosapi_msgs/TypeDef[]",)
    typedefs: list[TypeDef] = []
    """The goal first."""


class ActionResultDetailsRequest(Msg, frozen=True, gc=False):
    """Ask what an action's result is made of."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ActionResultDetailsRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    type: str = ""


class ActionResultDetailsResponse(Msg, frozen=True, gc=False):
    """What `ActionResultDetails` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ActionResultDetailsResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("rosapi_msgs/TypeDef[]",)
    typedefs: list[TypeDef] = []
    """The result first."""


class ActionTypeRequest(Msg, frozen=True, gc=False):
    """Ask for an action's type."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ActionTypeRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    action: str = ""


class ActionTypeResponse(Msg, frozen=True, gc=False):
    """What `ActionType` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ActionTypeResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    type: str = ""


class DeleteParamRequest(Msg, frozen=True, gc=False):
    """Forget a parameter."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/DeleteParamRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    name: str = ""


class DeleteParamResponse(Msg, frozen=True, gc=False):
    """What `DeleteParam` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/DeleteParamResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string")
    successful: bool = False
    reason: str = ""
    """Why not."""


class GetActionServersRequest(Msg, frozen=True, gc=False):
    """Ask which actions there are."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/GetActionServersRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class GetActionServersResponse(Msg, frozen=True, gc=False):
    """What `GetActionServers` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/GetActionServersResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string[]",)
    action_servers: list[str] = []


class GetParamNamesRequest(Msg, frozen=True, gc=False):
    """Ask which parameters there are."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/GetParamNamesRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class GetParamNamesResponse(Msg, frozen=True, gc=False):
    """What `GetParamNames` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/GetParamNamesResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string[]",)
    names: list[str] = []


class GetParamRequest(Msg, frozen=True, gc=False):
    """Ask for a parameter."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/GetParamRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "string")
    name: str = ""
    default_value: str = ""
    """As JSON; the answer when there is no such parameter."""


class GetParamResponse(Msg, frozen=True, gc=False):
    """What `GetParam` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/GetParamResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "bool", "string")
    value: str = ""
    """As JSON."""
    successful: bool = False
    reason: str = ""
    """Why not."""


class GetROSVersionRequest(Msg, frozen=True, gc=False):
    """Ask which ROS speaks here."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/GetROSVersionRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class GetROSVersionResponse(Msg, frozen=True, gc=False):
    """What `GetROSVersion` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/GetROSVersionResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint8", "string")
    version: uint8 = 0
    """1 or 2."""
    distro: str = ""


class GetTimeRequest(Msg, frozen=True, gc=False):
    """Ask what time it is."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/GetTimeRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class GetTimeResponse(Msg, frozen=True, gc=False):
    """What `GetTime` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/GetTimeResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("time",)
    time: Time = Time()


class HasParamRequest(Msg, frozen=True, gc=False):
    """Ask whether there is a parameter."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/HasParamRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    name: str = ""


class HasParamResponse(Msg, frozen=True, gc=False):
    """What `HasParam` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/HasParamResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool",)
    exists: bool = False


class InterfacesRequest(Msg, frozen=True, gc=False):
    """Ask which types there are."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/InterfacesRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class InterfacesResponse(Msg, frozen=True, gc=False):
    """What `Interfaces` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/InterfacesResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string[]",)
    interfaces: list[str] = []


class MessageDetailsRequest(Msg, frozen=True, gc=False):
    """Ask what a message is made of."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/MessageDetailsRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    type: str = ""


class MessageDetailsResponse(Msg, frozen=True, gc=False):
    """What `MessageDetails` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/MessageDetailsResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("rosapi_msgs/TypeDef[]",)
    typedefs: list[TypeDef] = []
    """The message first, then all that it is made of."""


class NodeDetailsRequest(Msg, frozen=True, gc=False):
    """Ask what a node does."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/NodeDetailsRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    node: str = ""


class NodeDetailsResponse(Msg, frozen=True, gc=False):
    """What `NodeDetails` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/NodeDetailsResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string[]", "string[]", "string[]")
    subscribing: list[str] = []
    """Topics."""
    publishing: list[str] = []
    """Topics."""
    services: list[str] = []


class NodesRequest(Msg, frozen=True, gc=False):
    """Ask which nodes there are."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/NodesRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ()


class NodesResponse(Msg, frozen=True, gc=False):
    """What `Nodes` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/NodesResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string[]",)
    nodes: list[str] = []


class PublishersRequest(Msg, frozen=True, gc=False):
    """Ask who publishes a topic."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/PublishersRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    topic: str = ""


class PublishersResponse(Msg, frozen=True, gc=False):
    """What `Publishers` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/PublishersResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string[]",)
    publishers: list[str] = []
    """Nodes."""


class SearchParamRequest(Msg, frozen=True, gc=False):
    """What `SearchParam` is asked."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/SearchParamRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    name: str = ""
    """A name, as a node at the root would write it."""


class SearchParamResponse(Msg, frozen=True, gc=False):
    """What `SearchParam` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/SearchParamResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    global_name: str = ""
    """The full name of the parameter that is meant; empty when there is none."""


class ServiceHostRequest(Msg, frozen=True, gc=False):
    """What `ServiceHost` is asked."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ServiceHostRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    service: str = ""


class ServiceHostResponse(Msg, frozen=True, gc=False):
    """What `ServiceHost` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ServiceHostResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    host: str = ""
    """The machine that answers it; empty for an unknown service."""


class ServiceNodeRequest(Msg, frozen=True, gc=False):
    """Ask who offers a service."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ServiceNodeRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    service: str = ""


class ServiceNodeResponse(Msg, frozen=True, gc=False):
    """What `ServiceNode` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ServiceNodeResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    node: str = ""


class ServiceProvidersRequest(Msg, frozen=True, gc=False):
    """Ask who offers services of a type."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ServiceProvidersRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    service: str = ""


class ServiceProvidersResponse(Msg, frozen=True, gc=False):
    """What `ServiceProviders` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ServiceProvidersResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string[]",)
    providers: list[str] = []


class ServiceRequestDetailsRequest(Msg, frozen=True, gc=False):
    """Ask what a service is asked with."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ServiceRequestDetailsRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    type: str = ""


class ServiceRequestDetailsResponse(Msg, frozen=True, gc=False):
    """What `ServiceRequestDetails` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ServiceRequestDetailsResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("rosapi_msgs/TypeDef[]",)
    typedefs: list[TypeDef] = []
    """The request first."""


class ServiceResponseDetailsRequest(Msg, frozen=True, gc=False):
    """Ask what a service answers with."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ServiceResponseDetailsRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    type: str = ""


class ServiceResponseDetailsResponse(Msg, frozen=True, gc=False):
    """What `ServiceResponseDetails` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ServiceResponseDetailsResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("rosapi_msgs/TypeDef[]",)
    typedefs: list[TypeDef] = []
    """The response first."""


class ServiceTypeRequest(Msg, frozen=True, gc=False):
    """Ask for a service's type."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ServiceTypeRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    service: str = ""


class ServiceTypeResponse(Msg, frozen=True, gc=False):
    """What `ServiceType` answers."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ServiceTypeResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    type: str = ""


class ServicesForTypeRequest(Msg, frozen=True, gc=False):
    """Ask which services are of a type."""

    MSGTYPE: ClassVar[str] = "rosapi_msgs/ServicesForTypeRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string",)
    type: str = ""


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
