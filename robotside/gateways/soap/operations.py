"""The operations of a robot by SOAP, and the one that a subscriber offers to it."""

from __future__ import annotations

from robotside.gateways.soap import envelope
from robotside.gateways.soap.messages import (
    Answer,
    Caller,
    CallService,
    Deliver,
    Done,
    FetchMessages,
    GetMessage,
    GoTo,
    Guide,
    GuideTo,
    Info,
    Message,
    Messages,
    MoveArm,
    Nothing,
    Notify,
    Places,
    Pose,
    PublishMessage,
    Refusal,
    StartTask,
    Status,
    Subscribe,
    Subscription,
    SubscriptionId,
    Time,
)
from robotside.gateways.soap.wsdl import Contract, Operation, contract

__all__ = ["NOTIFY", "OPERATIONS", "STOP", "robot_contract", "subscriber_contract"]

STOP = Operation(
    envelope.STOP, "Stops the robot and keeps it at rest; from anyone, at any time.", Nothing, Done
)

OPERATIONS = (
    Operation("GetInfo", "Who the robot is, and what it can do.", Nothing, Info),
    Operation("GetStatus", "What it does, who has control, whether STOP is pressed.", Nothing, Status),
    Operation("GetPose", "Where it is.", Nothing, Pose),
    Operation("GetTime", "The robot's time, by which commands are stamped.", Nothing, Time),
    Operation("ListPlaces", "The places that it knows by name.", Nothing, Places),
    STOP,
    Operation("Deliver", "Brings something from one place to another, each by its name.", Deliver, Done),
    Operation("GoTo", "Goes to a place.", GoTo, Done),
    Operation("GoHome", "Goes home.", Nothing, Done),
    Operation("GuideTo", "Leads a person along places.", GuideTo, Done),
    Operation("StartTask", "Starts any task.", StartTask, Done),
    Operation("Pause", "Pauses the task.", Nothing, Done),
    Operation("Resume", "Resumes the task or the queue.", Nothing, Done),
    Operation("Cancel", "Ends the task.", Nothing, Done),
    Operation("Confirm", "Answers what the task asks.", Nothing, Done),
    Operation("MoveArm", "Moves the arm.", MoveArm, Done),
    Operation("CallService", "Calls any service of the robot.", CallService, Answer),
    Operation("PublishMessage", "Gives the robot a message on a topic.", PublishMessage, Done),
    Operation("GetMessage", "The newest message of a topic, or the next one.", GetMessage, Message),
    Operation(
        "Subscribe", "Subscribes to topics, to be fetched or to be called back.", Subscribe, Subscription
    ),
    Operation("FetchMessages", "What came since the last fetch.", FetchMessages, Messages),
    Operation("Renew", "Lets a subscription live on.", SubscriptionId, Subscription),
    Operation("Unsubscribe", "Ends a subscription.", SubscriptionId, Done),
    Operation(
        "Leave",
        "The client is gone: control that it had is free, and a robot that it drove rests.",
        Nothing,
        Done,
    ),
    Operation("GetGuide", "How the robot is used by SOAP.", Nothing, Guide),
)
"""What the service `Robot` offers."""

NOTIFY = Operation("Notify", "New messages of a subscription.", Notify, Nothing)
"""What the service `Subscriber` of a client offers to the robot."""


def robot_contract() -> Contract:
    """The contract of the robot's service."""
    return contract("Robot", OPERATIONS, Caller, Refusal)


def subscriber_contract() -> Contract:
    """The contract of the service that a client offers for its callbacks."""
    return contract("Subscriber", (NOTIFY,), Caller, Refusal)
