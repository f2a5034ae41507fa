"""Text drawn into a texture."""

from collections.abc import Sequence
from typing import Any

from kivy.graphics.texture import Texture

DEFAULT_FONT: str

class LabelBase:
    text: str
    options: dict[str, Any]
    texture: Texture
    def __init__(
        self,
        text: str = "",
        font_size: float = 12,
        font_name: str = ...,
        bold: bool = False,
        italic: bool = False,
        halign: str = "left",
        valign: str = "bottom",
        color: Sequence[float] | None = None,
        text_size: tuple[float | None, float | None] | None = None,
        **kwargs: Any,
    ) -> None: ...
    @staticmethod
    def register(
        name: str,
        fn_regular: str,
        fn_italic: str | None = None,
        fn_bold: str | None = None,
        fn_bolditalic: str | None = None,
    ) -> None: ...
    def refresh(self) -> None: ...
    def render(self, real: bool = False) -> tuple[int, int]: ...
    def get_extents(self, text: str) -> tuple[int, int]: ...
    def shorten(self, text: str, margin: int = 2) -> str: ...
    @property
    def size(self) -> tuple[int, int]: ...
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    @property
    def content_size(self) -> tuple[int, int]: ...
    @property
    def content_width(self) -> int: ...
    @property
    def content_height(self) -> int: ...

Label: type[LabelBase]
