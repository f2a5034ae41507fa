"""Pictures from files and from memory."""

from typing import IO, Any

from kivy.event import EventDispatcher
from kivy.graphics.texture import Texture

class ImageData:
    fmt: str
    source: Any
    flip_vertical: bool
    def __init__(
        self,
        width: int,
        height: int,
        fmt: str,
        data: Any,
        source: Any = None,
        flip_vertical: bool = True,
        source_image: Any = None,
        rowlength: int = 0,
    ) -> None: ...
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    @property
    def data(self) -> Any: ...

class ImageLoader:
    loaders: list[Any]
    @staticmethod
    def register(defcls: type[Any]) -> None: ...
    @staticmethod
    def load(filename: str, **kwargs: Any) -> Any: ...

class Image(EventDispatcher):
    def __init__(
        self,
        arg: str | IO[bytes] | Texture | Image,
        *,
        ext: str = "",
        filename: str = "",
        mipmap: bool = False,
        nocache: bool = False,
        keep_data: bool = False,
        anim_delay: float = 0.25,
    ) -> None: ...
    @property
    def texture(self) -> Texture: ...
    @property
    def size(self) -> tuple[int, int]: ...
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    def save(self, filename: str, flipped: bool = False, fmt: str | None = None) -> bool: ...
    def read_pixel(self, x: int, y: int) -> list[float]: ...
