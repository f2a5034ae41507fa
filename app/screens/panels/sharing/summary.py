"""What a layout holds, in words, before it takes the place of anything."""

from __future__ import annotations

from app.layout.layout import Layout
from app.layout.view_checks import is_signal
from widgets.core.language import tr, trn

__all__ = ["summary"]


def summary(layout: Layout) -> str:
    """What a profile holds, in a few lines, before it takes the place of anything."""
    lines = [layout.title]
    drive = trn("{count} instrument", "{count} instruments", len(layout.instruments))
    hands = trn("{count} control", "{count} controls", len(layout.controls))
    lines.append(
        tr("Drive screen: {instruments}, {controls}").format(
            instruments=drive.format(count=len(layout.instruments)),
            controls=hands.format(count=len(layout.controls)),
        )
    )
    for view in layout.views:
        panels = trn("{count} panel", "{count} panels", len(view.panels)).format(count=len(view.panels))
        lines.append(f"{tr(view.title)}: {panels}")
    told = sorted({panel.topic for view in layout.views for panel in view.panels if is_signal(panel.widget)})
    if told:
        lines.append(tr("Switches for: {topics}").format(topics=", ".join(told)))
    return "\n".join(lines)
