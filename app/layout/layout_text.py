"""A layout as the text of its file, which reads back as the same layout."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import msgspec

from app.layout.layout import Layout
from app.layout.views import View

__all__ = ["text_of", "text_of_views"]

Struct = msgspec.Struct


def text_of(layout: Layout) -> str:
    """The file of the layout, drive screen and views."""
    lines = [f"title = {_value(layout.title)}"]
    if layout.robots:
        lines.append(f"for = {_value(layout.robots)}")
    lines.append(f"arrangement = {_value(layout.arrangement)}")
    parts = {"instrument": layout.instruments, "control": layout.controls, "action": layout.actions}
    for name, tables in parts.items():
        for table in tables:
            lines += ["", f"[[{name}]]", *_keys(table)]
    return "\n".join(lines) + "\n" + text_of_views(layout.views)


def text_of_views(views: tuple[View, ...]) -> str:
    """The part of a file that holds these views."""
    lines: list[str] = []
    for view in views:
        lines += ["", "[[view]]", f"title = {_value(view.title)}"]
        for panel in view.panels:
            lines += ["", "[[view.panel]]", *_keys(panel)]
    return "\n".join(lines) + "\n" if lines else ""


def _keys(table: Struct) -> Iterator[str]:
    """What is not as usual; a table's first key stands even where it is empty."""
    for field in msgspec.structs.fields(table):
        value = getattr(table, field.name)
        if field.required or value != field.default:
            yield f"{field.encode_name} = {_value(value)}"


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    return f"[{', '.join(_value(one) for one in value)}]"
