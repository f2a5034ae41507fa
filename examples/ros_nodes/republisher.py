"""tf2_web_republisher: transforms between the frames that a web page asks for, at the rate that it asks for."""

from __future__ import annotations

import asyncio
import itertools
import math
from collections.abc import Callable
from typing import Any

from bridge.client.client import BridgeClient
from bridge.core.errors import BridgeError, Refused
from bridge.msgs import TYPES, Msg
from bridge.msgs.geometry_msgs import Quaternion, Transform, TransformStamped
from bridge.msgs.rosapi_msgs import SubscribersRequest, SubscribersResponse
from bridge.msgs.std_msgs import Header, Time
from bridge.msgs.tf2_msgs import TFMessage
from examples.ros_nodes.actionlib import ActionlibServer, Begin
from examples.ros_nodes.transforms import Frames

__all__ = ["Republisher"]

MAX_WISHES = 50
"""Most pages that are served by topics at a time."""
MAX_RATE = 50.0
"""Highest rate [Hz]."""
MIN_TIMEOUT = 1.0
"""A topic stays for so long at least without a subscriber [s]."""
STATIC = TransformStamped(Header(Time(), "world"), "turtle1")
"""A frame that is always there, as a static_transform_publisher gives it."""


class Republisher:
    """Answers `/republish_tfs`, and goals of `/tf2_web_republisher` of either ROS."""

    def __init__(self, client: BridgeClient, begin: Begin) -> None:
        self._client, self._begin = client, begin
        self._frames = Frames()
        self._frames.add(STATIC)
        self._numbers = itertools.count()
        self._wishes = 0

    def bring_up(self) -> None:
        """Offer all of it."""
        kind = "tf2_web_republisher/TFSubscription"
        self._client.subscribe("/tf", TFMessage, self._on_tf, queue_length=100)
        self._client.serve("/republish_tfs", "tf2_web_republisher/RepublishTFs", self._republish)
        self._client.provide_action("/tf2_web_republisher", kind, self._run)
        ActionlibServer(self._client, self._begin, "/tf2_web_republisher", kind, self._run)

    def _on_tf(self, msg: TFMessage, _: float) -> None:
        for each in msg.transforms:
            self._frames.add(each)

    def _republish(self, asked: Any) -> Msg:
        if self._wishes >= MAX_WISHES:
            raise Refused(f"{MAX_WISHES} topics are republished already.")
        self._wishes += 1
        topic = f"/tf_repub_{next(self._numbers)}"
        self._client.advertise(topic, TYPES["tf2_web_republisher/TFArray"], latch=True)
        self._begin(self._serve_topic(topic, asked))
        return TYPES["tf2_web_republisher/RepublishTFsResponse"](topic)

    async def _serve_topic(self, topic: str, asked: Any) -> None:
        """Publish until nobody has subscribed for as long as was asked."""
        array = TYPES["tf2_web_republisher/TFArray"]
        republishing = self._begin(
            self._changes(asked, lambda found: self._client.publish(topic, array(found)))
        )
        try:
            while True:
                await asyncio.sleep(max(MIN_TIMEOUT, asked.timeout.seconds))
                if not await self._is_wanted(topic):
                    return
        finally:
            republishing.cancel()
            self._client.unadvertise(topic)
            self._wishes -= 1

    async def _is_wanted(self, topic: str) -> bool:
        try:
            found = await self._client.call(
                "/rosapi/subscribers", SubscribersRequest(topic), SubscribersResponse
            )
        except BridgeError:
            return True  # nobody knows: a page may be there
        return bool(found.subscribers)

    async def _run(self, goal: Any, on_feedback: Callable[[Msg], None]) -> Msg:
        feedback = TYPES["tf2_web_republisher/TFSubscriptionFeedback"]
        await self._changes(goal, lambda found: on_feedback(feedback(found)))
        return TYPES["tf2_web_republisher/TFSubscriptionResult"]()

    async def _changes(self, asked: Any, tell: Callable[[list[TransformStamped]], object]) -> None:
        """Tell the transforms that changed by more than the thresholds, for ever."""
        told: dict[str, Transform] = {}
        while True:
            found = [
                TransformStamped(Header(self._now(), asked.target_frame), source, transform)
                for source in asked.source_frames
                if (transform := self._frames.lookup(asked.target_frame, source)) is not None
                and (source not in told or _differ(told[source], transform, asked))
            ]
            told |= {each.child_frame_id: each.transform for each in found}
            if found:
                tell(found)
            await asyncio.sleep(1 / min(MAX_RATE, asked.rate if asked.rate > 0 else MAX_RATE))

    def _now(self) -> Time:
        now = self._client.robot_time()
        return Time.at(now) if math.isfinite(now) else Time()


def _differ(before: Transform, now: Transform, asked: Any) -> bool:
    """Whether a transform moved or turned by more than was asked to be left out [m], [rad]."""
    a, b = before.translation, now.translation
    moved = math.dist((a.x, a.y, a.z), (b.x, b.y, b.z))
    return moved > asked.trans_thres or _angle(before.rotation, now.rotation) > asked.angular_thres


def _angle(a: Quaternion, b: Quaternion) -> float:
    inner = abs(a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w)
    return 2 * math.acos(min(1.0, inner))
