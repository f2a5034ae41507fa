"""Kivy's stores of what was loaded."""

class Cache:
    @staticmethod
    def remove(category: str, key: object = None) -> None: ...
