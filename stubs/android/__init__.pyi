"""python-for-android's own module, which publishes no types; the stubs of Android's Java classes have the same name."""

from typing import Any

def __getattr__(name: str) -> Any: ...
