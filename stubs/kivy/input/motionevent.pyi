"""One touch, from down to up."""

from typing import Any

class MotionEvent:
    uid: int
    id: Any
    device: str
    is_touch: bool
    type_id: str
    profile: list[str]
    button: str
    pressure: float
    shape: Any
    x: float
    y: float
    z: float
    sx: float
    sy: float
    sz: float
    ox: float
    oy: float
    oz: float
    px: float
    py: float
    pz: float
    dx: float
    dy: float
    dz: float
    pos: tuple[float, float]
    ud: Any
    push_attrs: list[str]
    grab_list: list[Any]
    grab_current: Any
    grab_state: bool
    grab_exclusive_class: Any
    is_double_tap: bool
    is_triple_tap: bool
    double_tap_time: float
    time_start: float
    time_update: float
    time_end: float
    def __init__(
        self, device: str, id: Any, args: Any, is_touch: bool = False, type_id: str | None = None
    ) -> None: ...
    @property
    def spos(self) -> tuple[float, float]: ...
    @property
    def opos(self) -> tuple[float, float]: ...
    @property
    def ppos(self) -> tuple[float, float]: ...
    @property
    def dpos(self) -> tuple[float, float]: ...
    @property
    def is_mouse_scrolling(self) -> bool: ...
    def grab(self, class_instance: Any, exclusive: bool = False) -> None: ...
    def ungrab(self, class_instance: Any) -> None: ...
    def push(self, attrs: list[str] | None = None) -> None: ...
    def pop(self) -> None: ...
    def move(self, args: Any) -> None: ...
    def depack(self, args: Any) -> None: ...
    def scale_for_screen(
        self,
        w: float,
        h: float,
        p: float | None = None,
        rotation: int = 0,
        smode: str = "None",
        kheight: float = 0,
    ) -> None: ...
    def apply_transform_2d(self, transform: Any) -> None: ...
    def update_time_end(self) -> None: ...
    def distance(self, other_touch: MotionEvent) -> float: ...
