"""Names of values, by the constants of a message's definition: 2 of `power_supply_status` is DISCHARGING. No Kivy."""

from __future__ import annotations

from functools import lru_cache

from bridge.msgs import Msg

__all__ = ["meaning_of"]


def meaning_of(kind: type[Msg], field: str, value: int) -> str:
    """What the definition of a message calls this value of that field; empty where it has no name for it."""
    return _names(kind).get(field, {}).get(value, "")


@lru_cache(maxsize=512)
def _names(kind: type[Msg]) -> dict[str, dict[int, str]]:
    """Field to value to name. A constant is of the field whose name it begins with; one of none is of the only whole number."""
    constants = {
        name: value
        for name, value in vars(kind).items()
        if name.isupper() and type(value) is int and not name.startswith("_")
    }
    if not constants:
        return {}
    types = dict(zip(kind.__struct_fields__, getattr(kind, "ROSTYPES", ()), strict=False))
    whole = [
        name for name, base in types.items() if base.lstrip("u").startswith("int") or base in ("byte", "char")
    ]
    single = [name for name in whole if "[" not in types[name]]
    found: dict[str, dict[int, str]] = {}
    for name, value in constants.items():
        own = max((one for one in single if name.startswith(one.upper() + "_")), key=len, default="")
        field, said = (own, name[len(own) + 1 :]) if own else (single[0] if len(single) == 1 else "", name)
        if field:
            found.setdefault(field, {}).setdefault(value, said)
    return found
