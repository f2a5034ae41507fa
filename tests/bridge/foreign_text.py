"""Text as the server that is not ours reads and writes it."""

from __future__ import annotations

import base64
import io
import json
import logging
import math
from typing import Any

from PIL import Image

log = logging.getLogger(__name__)


def resolved(name: str) -> str:
    """A name from the root."""
    return "/" + name.lstrip("/")


def operations(raw: str | bytes) -> list[dict[str, Any]]:
    """One or several JSON objects; nothing for what is none."""
    text, found, decoder = raw.decode() if isinstance(raw, bytes) else raw, [], json.JSONDecoder()
    while text := text.strip():
        try:
            op, end = decoder.raw_decode(text)
        except ValueError:
            log.warning("no JSON: %.60s", text)
            break
        if isinstance(op, dict):
            found.append(op)
        text = text[end:]
    return found


def dump(op: dict[str, Any], ros: int) -> str:
    """As JSON in the manner of `ros`."""
    text = json.dumps(op, separators=(",", ":") if ros == 1 else None)
    return text.replace("/", "\\/") if ros == 1 else text


def as_png(text: str) -> str:
    """Base64 of a picture whose pixels are the text."""
    data = text.encode()
    width = math.ceil(math.sqrt(len(data) / 3))
    height = math.ceil(len(data) / (3 * width))
    out = io.BytesIO()
    Image.frombytes("RGB", (width, height), data.ljust(width * height * 3, b"\n")).save(out, "PNG")
    return base64.b64encode(out.getvalue()).decode()
