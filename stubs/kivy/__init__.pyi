"""Types of what of Kivy the app and the widgets use; Kivy itself publishes none."""

from collections.abc import Sequence

__version__: str
kivy_home_dir: str
kivy_data_dir: str
kivy_options: dict[str, Sequence[str]]

def require(version: str) -> None: ...
