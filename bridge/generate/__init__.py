"""Typed message classes from ROS text: `python -m bridge.generate FILE… --out DIR`; `bridge.generate.writing` has the function.

The parser is rosbags', which only this package needs; what it makes needs `bridge.msgs` and msgspec alone.
"""
