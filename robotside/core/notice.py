"""A sentence for the operator with the code that programs go by.

Notice(Code.STOP_PRESSED, f"STOP pressed by {name}.", actor_id=id, name=name)
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Literal, Protocol, Self, TypeAlias

from bridge.core.codes import Code
from bridge.msgs.diagnostic_msgs import KeyValue
from robotside.core.text import plain

__all__ = ["MAX_KEY", "MAX_PARAMETERS", "MAX_VALUE", "Notice", "Problem", "coded"]

MAX_KEY, MAX_VALUE = 64, 300
"""Characters kept of a code, an id or a key, and of a value: a client's own words may stand in them."""
MAX_PARAMETERS = 16
"""Parameters kept of what another program said."""


class Notice(str):
    """One sentence that carries its code, whom it is about, and what it names.

    It is its own text, so that it can be shown, joined and compared like one. What is made of it by joining is a plain
    text without a code, unless it is made by `reworded`.
    """

    __slots__ = ("actor_id", "code", "parameters")
    code: str
    """As of `bridge.core.codes`; empty only for a text of another program that has none."""
    actor_id: str
    """The public id of the client that caused it, or that it is about; empty for none, and when it is not known."""
    parameters: Mapping[str, str]
    """Its parameters, by the keys of its code."""

    def __new__(cls, code: Code, text: str, /, *, actor_id: str = "", **parameters: str | float) -> Self:
        """The sentence `text` of a `code`, with a value for each of its parameters; numbers in SI units."""
        values = {key: _shown(value) for key, value in parameters.items()}
        return cls._made(text, code.value, actor_id, values)

    @classmethod
    def of(cls, text: str, said: _Coded | None = None) -> Self:
        """A `text` with the code of the message it is from; without one where another program gave none."""
        if said is None:
            return cls._made(text, "", "", {})
        return cls._made(text, said.code, said.actor_id, {pair.key: pair.value for pair in said.parameters})

    def reworded(self, text: str) -> Self:
        """The same in other words, as in a sentence round it."""
        return self._made(text, self.code, self.actor_id, self.parameters)

    @classmethod
    def _made(cls, text: str, code: str, actor_id: str, parameters: Mapping[str, str]) -> Self:
        notice = str.__new__(cls, text)
        notice.code, notice.actor_id, notice.parameters = code, actor_id, parameters
        return notice


Problem: TypeAlias = Notice | Literal[""]
"""Why something is not done; empty when it is."""


class _Coded(Protocol):
    """A message that has a code."""

    @property
    def code(self) -> str: ...
    @property
    def actor_id(self) -> str: ...
    @property
    def parameters(self) -> Iterable[KeyValue]: ...


def coded(text: str) -> dict[str, Any]:
    """The fields of a message that carry the code of a `text`; empty ones where it has none."""
    if not isinstance(text, Notice):
        return {"code": "", "actor_id": "", "parameters": []}
    pairs = [(plain(key, MAX_KEY), plain(value, MAX_VALUE)) for key, value in text.parameters.items()]
    return {
        "code": plain(text.code, MAX_KEY),
        "actor_id": plain(text.actor_id, MAX_KEY),
        "parameters": [KeyValue(*pair) for pair in pairs[:MAX_PARAMETERS]],
    }


def _shown(value: str | float) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
