"""Classes by the names that kv knows them by."""

from typing import Any

Factory: Any
