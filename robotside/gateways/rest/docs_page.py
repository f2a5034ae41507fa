"""The description of the gateway as one page, which loads nothing from anywhere."""

from __future__ import annotations

import html
from typing import Any

__all__ = ["docs_page"]

_PAGE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>{title}</title>
<style>body{{font-family:sans-serif;max-width:70em;margin:2em auto;padding:0 1em}}
td,th{{text-align:left;padding:.2em 1em .2em 0;vertical-align:top}}code{{background:#eee;padding:.1em .3em}}</style>
<h1>{title}</h1><p>{about}</p>
<p><a href="openapi.json">openapi.json</a> has all of it, with the schemas; <a href="guide">guide</a> has lines that can be pasted.</p>
<table><tr><th>method</th><th>path</th><th>what</th><th>body</th></tr>{rows}</table></html>"""
_ROW = "<tr><td>{method}</td><td><code>{path}</code></td><td>{what}</td><td>{body}</td></tr>"


def docs_page(described: dict[str, Any]) -> str:
    """The page, in HTML, of an OpenAPI description."""
    info = described["info"]
    rows = [
        _ROW.format(
            method=method.upper(),
            path=html.escape(path),
            what=html.escape(operation.get("summary", "")),
            body=_body(operation),
        )
        for path, methods in described["paths"].items()
        for method, operation in methods.items()
    ]
    about = html.escape(info.get("description", ""))
    return _PAGE.format(title=html.escape(info["title"]), about=about, rows="\n".join(rows))


def _body(operation: dict[str, Any]) -> str:
    content = operation.get("requestBody", {}).get("content", {}).get("application/json", {})
    example = content.get("example")
    return "" if example is None else f"<code>{html.escape(_json(example))}</code>"


def _json(value: Any) -> str:
    import json

    return json.dumps(value)
