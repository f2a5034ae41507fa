"""The app's icon and start picture: the robot's arrow in its ring. Run it when the design changes."""

from __future__ import annotations

from pathlib import Path

from PIL import Image, ImageDraw

APP = Path(__file__).parents[1] / "app"
GROUND, SURFACE, ACCENT, EDGE = "#0C1015", "#1D2530", "#4CC2FF", "#EAF0F7"
SIZE, FINE = 512, 4
"""Of the icon [px], and how much finer it is drawn."""
RING, RIM = 0.36, 0.036
"""Radius of the ring and width of its edge, as parts of the icon."""
ARROW = ((0.0, 0.25), (0.17, -0.19), (0.0, -0.10), (-0.17, -0.19))
"""Corners from the middle, x right and y up, as parts of the icon."""


def mark(size: int) -> Image.Image:
    """The ring with the arrow, on nothing, `size` [px] wide."""
    wide = size * FINE
    image = Image.new("RGBA", (wide, wide))
    draw = ImageDraw.Draw(image)
    for radius, colour in ((RING + RIM, EDGE), (RING, ACCENT)):
        low, high = (0.5 - radius) * wide, (0.5 + radius) * wide
        draw.ellipse((low, low, high, high), fill=colour)
    draw.polygon([((0.5 + x) * wide, (0.5 - y) * wide) for x, y in ARROW], fill=GROUND)
    return image.resize((size, size), Image.Resampling.LANCZOS)


def icon() -> Image.Image:
    """The icon: the mark on a rounded square."""
    square = Image.new("RGBA", (SIZE * FINE, SIZE * FINE))
    box = (0, 0, SIZE * FINE - 1, SIZE * FINE - 1)
    ImageDraw.Draw(square).rounded_rectangle(box, radius=SIZE * FINE * 0.22, fill=SURFACE)
    square = square.resize((SIZE, SIZE), Image.Resampling.LANCZOS)
    square.alpha_composite(mark(SIZE))
    return square


if __name__ == "__main__":
    icon().save(APP / "icon.png", optimize=True)
    start = Image.new("RGBA", (SIZE, SIZE), GROUND)
    start.alpha_composite(mark(SIZE // 2), (SIZE // 4, SIZE // 4))
    start.convert("RGB").save(APP / "presplash.png", optimize=True)
