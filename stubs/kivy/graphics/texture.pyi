"""Pictures on the graphics card."""

from collections.abc import Callable
from typing import Any

from kivy.core.image import ImageData

class Texture:
    mag_filter: str
    min_filter: str
    wrap: str | None
    uvpos: tuple[float, float]
    uvsize: tuple[float, float]
    @staticmethod
    def create(
        size: tuple[int, int] | None = None,
        colorfmt: str | None = None,
        bufferfmt: str | None = None,
        mipmap: bool = False,
        callback: Callable[[Texture], Any] | None = None,
        icolorfmt: str | None = None,
    ) -> Texture: ...
    @staticmethod
    def create_from_data(im: ImageData, mipmap: bool = False) -> Texture: ...
    @property
    def id(self) -> int: ...
    @property
    def size(self) -> tuple[int, int]: ...
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    @property
    def colorfmt(self) -> str: ...
    @property
    def pixels(self) -> bytes: ...
    @property
    def tex_coords(self) -> tuple[float, ...]: ...
    def blit_buffer(
        self,
        pbuffer: Any,
        size: tuple[int, int] | None = None,
        colorfmt: str | None = None,
        pos: tuple[int, int] | None = None,
        bufferfmt: str | None = None,
        mipmap_level: int = 0,
        mipmap_generation: bool = True,
        rowlength: int = 0,
    ) -> None: ...
    def add_reload_observer(self, callback: Callable[[Texture], Any]) -> None: ...
    def remove_reload_observer(self, callback: Callable[[Texture], Any]) -> None: ...
    def flip_horizontal(self) -> None: ...
    def flip_vertical(self) -> None: ...
    def get_region(self, x: float, y: float, width: float, height: float) -> Texture: ...
    def bind(self) -> None: ...
