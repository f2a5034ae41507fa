"""Kivy's own settings."""

from configparser import ConfigParser as PythonConfigParser
from typing import Any

class ConfigParser(PythonConfigParser):
    def set(self, section: str, option: str, value: Any) -> None: ...  # type: ignore[override]
    def getdefault(self, section: str, option: str, defaultvalue: Any) -> Any: ...

Config: ConfigParser
