"""Types of what of Kivy the app and the widgets use; Kivy itself publishes none."""

__version__: str
kivy_home_dir: str
kivy_data_dir: str

def require(version: str) -> None: ...
