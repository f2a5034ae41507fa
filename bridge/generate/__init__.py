"""Typed message classes from ROS text: `python -m bridge.generate FILE… --out DIR`.

The parser is rosbags', which only this package needs; what it makes needs `bridge.msgs` and msgspec alone.
"""

from __future__ import annotations

from bridge.generate.model import TextError
from bridge.generate.writing import generate

__all__ = ["TextError", "generate"]
