"""Instructions for a canvas."""

from collections.abc import Callable, Sequence
from types import TracebackType
from typing import Any, Self

from kivy.graphics.texture import Texture
from kivy.graphics.transformation import Matrix
from kivy.properties import Property

class Instruction:
    group: str | None
    needs_redraw: bool
    def __init__(self, *, group: str | None = None, noinline: bool = False) -> None: ...
    def flag_update(self) -> None: ...
    @property
    def proxy_ref(self) -> Any: ...

class InstructionGroup(Instruction):
    children: list[Instruction]
    @property
    def length(self) -> int: ...
    def add(self, c: Instruction) -> None: ...
    def insert(self, index: int, c: Instruction) -> None: ...
    def remove(self, c: Instruction) -> None: ...
    def clear(self) -> None: ...
    def remove_group(self, groupname: str) -> None: ...
    def get_group(self, groupname: str) -> list[Instruction]: ...
    def indexof(self, c: Instruction) -> int: ...

class CanvasBase(InstructionGroup):
    def __enter__(self) -> Self: ...
    def __exit__(
        self, exc_type: type[BaseException] | None, exc: BaseException | None, tb: TracebackType | None
    ) -> None: ...

class Canvas(CanvasBase):
    before: CanvasBase
    after: CanvasBase
    opacity: float
    @property
    def has_before(self) -> bool: ...
    @property
    def has_after(self) -> bool: ...
    def ask_update(self) -> None: ...
    def draw(self) -> None: ...

class Shader:
    fs: str
    vs: str
    @property
    def success(self) -> bool: ...

class RenderContext(Canvas):
    shader: Shader
    use_parent_projection: bool
    use_parent_modelview: bool
    use_parent_frag_modelview: bool
    def __init__(
        self,
        *,
        compute_normal_mat: bool = False,
        use_parent_projection: bool = False,
        use_parent_modelview: bool = False,
        use_parent_frag_modelview: bool = False,
        fs: str | None = None,
        vs: str | None = None,
        nocompiler: bool = False,
        with_depthbuffer: bool = False,
        group: str | None = None,
        noinline: bool = False,
    ) -> None: ...
    def __getitem__(self, key: str) -> Any: ...
    def __setitem__(self, key: str, value: Any) -> None: ...

class ContextInstruction(Instruction): ...

class Color(ContextInstruction):
    r: float
    g: float
    b: float
    a: float
    h: float
    s: float
    v: float
    rgba: Property[list[float], Sequence[float]]
    rgb: Property[list[float], Sequence[float]]
    hsv: Property[list[float], Sequence[float]]
    def __init__(
        self,
        *values: float,
        rgba: Sequence[float] = ...,
        rgb: Sequence[float] = ...,
        hsv: Sequence[float] = ...,
        r: float = ...,
        g: float = ...,
        b: float = ...,
        a: float = ...,
        mode: str = ...,
        noadd: bool = False,
        group: str | None = None,
    ) -> None: ...

class BindTexture(ContextInstruction):
    index: int
    texture: Texture | None
    source: str | None
    def __init__(
        self,
        *,
        index: int = ...,
        texture: Texture | None = ...,
        source: str | None = ...,
        group: str | None = None,
    ) -> None: ...

class PushMatrix(ContextInstruction): ...
class PopMatrix(ContextInstruction): ...
class LoadIdentity(ContextInstruction): ...

class MatrixInstruction(ContextInstruction):
    matrix: Matrix

class Transform(MatrixInstruction):
    def identity(self) -> None: ...

class Rotate(Transform):
    angle: float
    axis: Property[tuple[float, ...], Sequence[float]]
    origin: Property[tuple[float, ...], Sequence[float]]
    def __init__(
        self,
        *args: float,
        angle: float = ...,
        axis: Sequence[float] = ...,
        origin: Sequence[float] = ...,
        group: str | None = None,
    ) -> None: ...
    def set(self, angle: float, ax: float, ay: float, az: float) -> None: ...

class Scale(Transform):
    x: float
    y: float
    z: float
    xyz: Property[tuple[float, ...], Sequence[float]]
    origin: Property[tuple[float, ...], Sequence[float]]
    def __init__(
        self,
        *args: float,
        x: float = ...,
        y: float = ...,
        z: float = ...,
        xyz: Sequence[float] = ...,
        origin: Sequence[float] = ...,
        group: str | None = None,
    ) -> None: ...

class Translate(Transform):
    x: float
    y: float
    z: float
    xy: Property[tuple[float, ...], Sequence[float]]
    xyz: Property[tuple[float, ...], Sequence[float]]
    def __init__(
        self,
        *args: float,
        x: float = ...,
        y: float = ...,
        z: float = ...,
        xy: Sequence[float] = ...,
        xyz: Sequence[float] = ...,
        group: str | None = None,
    ) -> None: ...

class StencilPush(Instruction):
    def __init__(self, *, clear_stencil: bool = ..., group: str | None = None) -> None: ...

class StencilPop(Instruction): ...
class StencilUse(Instruction): ...
class StencilUnUse(Instruction): ...
class ScissorPush(Instruction): ...
class ScissorPop(Instruction): ...

class ChangeState(Instruction):
    def __init__(self, *, noadd: bool = False, **states: Any) -> None: ...

class Callback(Instruction):
    def __init__(
        self,
        callback: Callable[..., Any] | None = None,
        *,
        reset_context: bool = False,
        noadd: bool = False,
        group: str | None = None,
    ) -> None: ...
    def ask_update(self) -> None: ...

class VertexInstruction(Instruction):
    texture: Texture | None
    source: str | None
    tex_coords: Property[list[float], Sequence[float]]

class Mesh(VertexInstruction):
    vertices: Property[Any, Any]
    indices: Property[Any, Any]
    mode: str
    def __init__(
        self,
        *,
        vertices: Any = ...,
        indices: Any = ...,
        mode: str = ...,
        fmt: Any = ...,
        texture: Texture | None = ...,
        source: str | None = ...,
        group: str | None = None,
    ) -> None: ...

class Line(VertexInstruction):
    points: Property[list[float], Any]
    width: float
    cap: str
    joint: str
    close: bool
    circle: Property[Any, Sequence[Any]]
    ellipse: Property[Any, Sequence[Any]]
    rectangle: Property[Any, Sequence[float]]
    rounded_rectangle: Property[Any, Sequence[Any]]
    bezier: Property[Any, Sequence[float]]
    dash_length: float
    dash_offset: float
    def __init__(
        self,
        *,
        points: Any = ...,
        width: float = ...,
        cap: str = ...,
        joint: str = ...,
        close: bool = ...,
        circle: Sequence[Any] = ...,
        ellipse: Sequence[Any] = ...,
        rectangle: Sequence[float] = ...,
        rounded_rectangle: Sequence[Any] = ...,
        bezier: Sequence[float] = ...,
        dash_length: float = ...,
        dash_offset: float = ...,
        noadd: bool = False,
        group: str | None = None,
    ) -> None: ...
    def add_point(self, x: float, y: float) -> None: ...

class SmoothLine(Line):
    overdraw_width: float

class Triangle(VertexInstruction):
    points: Property[list[float], Sequence[float]]
    def __init__(self, *, points: Sequence[float] = ..., group: str | None = None) -> None: ...

class Quad(VertexInstruction):
    points: Property[list[float], Sequence[float]]
    def __init__(self, *, points: Sequence[float] = ..., texture: Texture | None = ...) -> None: ...

class Rectangle(VertexInstruction):
    pos: Property[tuple[float, float], Sequence[float]]
    size: Property[tuple[float, float], Sequence[float]]
    def __init__(
        self,
        *,
        pos: Sequence[float] = ...,
        size: Sequence[float] = ...,
        texture: Texture | None = ...,
        source: str | None = ...,
        tex_coords: Sequence[float] = ...,
        noadd: bool = False,
        group: str | None = None,
    ) -> None: ...

class Ellipse(Rectangle):
    segments: int
    angle_start: float
    angle_end: float
    def __init__(
        self,
        *,
        pos: Sequence[float] = ...,
        size: Sequence[float] = ...,
        segments: int = ...,
        angle_start: float = ...,
        angle_end: float = ...,
        texture: Texture | None = ...,
        source: str | None = ...,
        group: str | None = None,
    ) -> None: ...

class RoundedRectangle(Rectangle):
    radius: Property[list[Any], Sequence[Any]]
    segments: Property[Any, Any]
    def __init__(
        self,
        *,
        pos: Sequence[float] = ...,
        size: Sequence[float] = ...,
        radius: Sequence[Any] = ...,
        segments: Any = ...,
        texture: Texture | None = ...,
        source: str | None = ...,
        group: str | None = None,
    ) -> None: ...

class BorderImage(Rectangle):
    border: Property[list[float], Sequence[float]]
    auto_scale: str
    display_border: Property[list[float], Sequence[float]]

class SmoothRectangle(Rectangle): ...
class SmoothEllipse(Ellipse): ...
class SmoothRoundedRectangle(RoundedRectangle): ...

class Fbo(RenderContext):
    size: tuple[int, int]
    @property
    def texture(self) -> Texture: ...
    @property
    def pixels(self) -> bytes: ...
    def bind(self) -> None: ...
    def release(self) -> None: ...
    def clear_buffer(self) -> None: ...

class ClearColor(Instruction):
    def __init__(self, r: float, g: float, b: float, a: float) -> None: ...

class ClearBuffers(Instruction):
    def __init__(
        self, *, clear_color: bool = True, clear_stencil: bool = False, clear_depth: bool = False
    ) -> None: ...
