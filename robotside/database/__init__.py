"""What the robot keeps while it is switched off, behind one door: `Records`."""

from __future__ import annotations

from robotside.database.jobs import Job, NotRecorded
from robotside.database.places import KINDS
from robotside.database.records import Records
from robotside.database.runs import UnderWay

__all__ = ["KINDS", "Job", "NotRecorded", "Records", "UnderWay"]
