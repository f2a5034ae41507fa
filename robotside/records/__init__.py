"""The records that outlive a restart, behind one class: `Records`."""

from __future__ import annotations

from robotside.records.database.jobs import Job, NotRecorded
from robotside.records.places import KINDS
from robotside.records.records import Records
from robotside.records.runs import UnderWay

__all__ = ["KINDS", "Job", "NotRecorded", "Records", "UnderWay"]
