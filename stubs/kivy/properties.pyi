"""Kivy's properties as descriptors, so that a widget's field has a type.

`speed = NumericProperty(0.0)` is read as a float and takes a float or a text such as "12dp". What Kivy cannot say itself is said by an annotation:
`index: NumericProperty[int] = NumericProperty(0)`, `datum: ObjectProperty[Datum | None] = ObjectProperty(None, allownone=True)`.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Generic, Never, Self, overload

from typing_extensions import TypeVar

_Read_co = TypeVar("_Read_co", covariant=True)
_Written_contra = TypeVar("_Written_contra", contravariant=True)
_Number = TypeVar("_Number", default=float)
_Value = TypeVar("_Value", default=Any)
_Key = TypeVar("_Key", default=Any)
_Choice = TypeVar("_Choice", default=str)

class Property(Generic[_Read_co, _Written_contra]):
    @overload
    def __get__(self, obj: None, owner: type[Any]) -> Self: ...
    @overload
    def __get__(self, obj: object, owner: type[Any]) -> _Read_co: ...
    def __set__(self, obj: Any, value: _Written_contra) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def defaultvalue(self) -> Any: ...
    def bind(self, obj: Any, observer: Callable[..., Any]) -> None: ...
    def fbind(
        self, obj: Any, observer: Callable[..., Any], ref: int = 0, largs: tuple[Any, ...] = (), **kwargs: Any
    ) -> int: ...
    def unbind(self, obj: Any, observer: Callable[..., Any]) -> None: ...
    def dispatch(self, obj: Any) -> None: ...
    def get(self, obj: Any) -> _Read_co: ...
    def set(self, obj: Any, value: _Written_contra) -> bool: ...
    def link(self, obj: Any, name: str) -> Any: ...

class NumericProperty(Property[_Number, _Number | float | str]):
    def __init__(self, defaultvalue: float | str | None = 0, **kwargs: Any) -> None: ...
    def get_format(self, obj: Any) -> str: ...

class BoundedNumericProperty(NumericProperty[_Number]):
    def __init__(
        self,
        defaultvalue: float | str | None = 0,
        *,
        min: float | None = None,
        max: float | None = None,
        errorvalue: Any = ...,
        errorhandler: Callable[[Any], Any] = ...,
        **kwargs: Any,
    ) -> None: ...

class StringProperty(Property[str, str]):
    def __init__(self, defaultvalue: str | None = "", **kwargs: Any) -> None: ...

class BooleanProperty(Property[bool, bool]):
    def __init__(self, defaultvalue: bool = True, **kwargs: Any) -> None: ...

class OptionProperty(Property[_Choice, _Choice]):
    def __init__(self, defaultvalue: Any, *, options: Iterable[Any], **kwargs: Any) -> None: ...
    @property
    def options(self) -> list[Any]: ...

class ObjectProperty(Property[_Value, _Value]):
    def __init__(self, defaultvalue: Any = None, rebind: bool = False, **kwargs: Any) -> None: ...

class ListProperty(Property[list[_Value], Iterable[_Value]]):
    def __init__(self, defaultvalue: Iterable[Any] | None = ..., **kwargs: Any) -> None: ...

class DictProperty(Property[dict[_Key, _Value], Mapping[_Key, _Value]]):
    def __init__(
        self, defaultvalue: Mapping[Any, Any] | None = ..., rebind: bool = False, **kwargs: Any
    ) -> None: ...

class VariableListProperty(Property[list[float], Sequence[float | str] | float | str]):
    def __init__(self, defaultvalue: Any = ..., length: int = 4, **kwargs: Any) -> None: ...

class ReferenceListProperty(Property[list[_Value], Sequence[_Value]]):
    def __init__(self, *properties: Property[Any, Any], **kwargs: Any) -> None: ...

class ColorProperty(Property[list[float], Sequence[float] | str | None]):
    def __init__(self, defaultvalue: Sequence[float] | str | None = ..., **kwargs: Any) -> None: ...

class AliasProperty(Property[_Read_co, _Written_contra]):
    @overload
    def __init__(
        self: AliasProperty[_Read_co, Never],
        getter: Callable[[Any], _Read_co],
        setter: None = None,
        rebind: bool = False,
        watch_before_use: bool = True,
        **kwargs: Any,
    ) -> None: ...
    @overload
    def __init__(
        self,
        getter: Callable[[Any], _Read_co],
        setter: Callable[[Any, _Written_contra], object],
        rebind: bool = False,
        watch_before_use: bool = True,
        **kwargs: Any,
    ) -> None: ...
