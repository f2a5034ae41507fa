"""Where tiles come from."""

from typing import Any

class MapSource:
    min_zoom: int
    max_zoom: int
    bounds: tuple[float, float, float, float]
    dp_tile_size: float
    cache_key: str
    tile_size: int
    image_ext: str
    attribution: str
    def __init__(
        self,
        url: str = "",
        cache_key: str | None = None,
        min_zoom: int = 0,
        max_zoom: int = 19,
        tile_size: int = 256,
        image_ext: str = "png",
        attribution: str = "",
        subdomains: str = "abc",
        **kwargs: Any,
    ) -> None: ...
    def get_x(self, zoom: float, lon: float) -> float: ...
    def get_y(self, zoom: float, lat: float) -> float: ...
    def get_lon(self, zoom: float, x: float) -> float: ...
    def get_lat(self, zoom: float, y: float) -> float: ...
    def get_row_count(self, zoom: int) -> int: ...
    def get_col_count(self, zoom: int) -> int: ...
    def get_min_zoom(self) -> int: ...
    def get_max_zoom(self) -> int: ...
    def fill_tile(self, tile: Any) -> None: ...
