"""What robots and handhelds agree on for mDNS."""

from __future__ import annotations

__all__ = ["SERVICE_TYPE"]

SERVICE_TYPE = "_pilothouse._tcp.local."
"""Service type of a robot (RFC 6763); its port is that of the robot's socket."""
