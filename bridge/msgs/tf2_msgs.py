"""tf2_msgs: where the frames are."""

from __future__ import annotations

from typing import ClassVar

from bridge.msgs.base import Msg
from bridge.msgs.geometry_msgs import TransformStamped

__all__ = ["TFMessage"]


class TFMessage(Msg, frozen=True, gc=False):
    """Some edges of the frame tree (REP-105)."""

    MSGTYPE: ClassVar[str] = "tf2_msgs/TFMessage"
    transforms: list[TransformStamped] = []
