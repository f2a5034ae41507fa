"""The description of the gateway as one page, which loads nothing from anywhere."""

from __future__ import annotations

import html
import json
from typing import Any

from robotside.gateways.usage_sheet.rendering import style

__all__ = ["docs_page"]

_PAGE = """<!doctype html><html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width,initial-scale=1"><title>{title}</title>
{style}</head><body>
<header><div><h1>{title}</h1></div></header><main><p>{about}</p>
<p><a href="openapi.json">openapi.json</a> has all of it, with the schemas; <a href="guide">guide</a> has lines that can be pasted.</p>
{rows}</main></body></html>"""
_ROW = """<div class="line"><span class="tag">{method}</span> <code class="name">{path}</code>
<p class="quiet">{what}</p>{bodies}</div>"""
_BODY = "<pre>{body}</pre>"
_BODY_FOR = '<p class="quiet">as for <code>{path}</code>:</p><pre>{body}</pre>'


def docs_page(described: dict[str, Any], base: str = "") -> str:
    """The page, in HTML, of an OpenAPI description; `base` is the path of the gateway on the site."""
    info = described["info"]
    rows = [
        _ROW.format(
            method=method.upper(),
            path=html.escape(base + path),
            what=html.escape(operation.get("summary", "")),
            bodies=_bodies(operation, base + path),
        )
        for path, methods in described["paths"].items()
        for method, operation in methods.items()
    ]
    about = html.escape(info.get("description", ""))
    return _PAGE.format(style=style(), title=html.escape(info["title"]), about=about, rows="\n".join(rows))


def _bodies(operation: dict[str, Any], path: str) -> str:
    """What can be sent: one example, or some of which each names what the path is then."""
    content = operation.get("requestBody", {}).get("content", {}).get("application/json", {})
    if "example" in content:
        return _BODY.format(body=_shown(content["example"]))
    return "".join(
        _BODY_FOR.format(path=html.escape(path.replace("{name}", name)), body=_shown(each["value"]))
        for name, each in content.get("examples", {}).items()
    )


def _shown(value: Any) -> str:
    return html.escape(json.dumps(value, ensure_ascii=False))
