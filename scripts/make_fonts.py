"""The rebuilding of widgets/fonts from the packages that hold the whole fonts.

Fetch them first, with the machine's own package tools, into one folder:

    apt-get download fonts-b612 && dpkg-deb -x fonts-b612_*.deb b612
    apt-get download fonts-noto-cjk && dpkg-deb -x fonts-noto-cjk_*.deb noto
    npm pack @material-symbols/font-500 && tar xzf material-symbols-font-500-*.tgz

Then `python scripts/make_fonts.py FOLDER`. Needs fonttools and brotli.
"""

from __future__ import annotations

import gzip
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from fontTools.pens.cu2quPen import Cu2QuPen
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.subset import Options, Subsetter
from fontTools.ttLib import TTCollection, TTFont, newTable
from fontTools.varLib.instancer import instantiateVariableFont

from widgets.core.icons import FILLED, OUTLINED, filled_code

FONTS = Path(__file__).parents[1] / "widgets" / "fonts"
TEXT = [*range(0x20, 0x180), *range(0x2010, 0x2030), *map(ord, "′″←↑→↓−≈≠≤≥×÷±°²³µ€")]
"""Latin with its accents, dashes, arrows and the signs of measured values."""
HAIR_SPACE = 170
"""Width of a hair space [1/2000 of the letter height]."""
FACES = ("B612-Regular", "B612-Bold")
CHINESE, CHINESE_FACES = "Noto Sans CJK SC", ("Regular", "Bold")
CHINESE_SIGNS = "，。、；：？！（）《》「」【】“”‘’…—·￥"


def subset(font: TTFont, codes: list[int]) -> TTFont:
    """Throw away every glyph that none of `codes` needs."""
    options = Options(layout_features=["kern", "mark", "mkmk"], name_IDs=[0, 1, 2, 3, 4, 5, 6, 13, 14])
    options.glyph_names = True
    subsetter = Subsetter(options)
    subsetter.populate(unicodes=codes)
    subsetter.subset(font)
    return font


def to_truetype(font: TTFont) -> TTFont:
    """Turn the cubic outlines of an OpenType font into the quadratic ones that every Android draws alike."""
    glyphs, order = font.getGlyphSet(), font.getGlyphOrder()
    drawn = {name: quadratic(glyphs[name]) for name in order}
    font["loca"], font["glyf"] = newTable("loca"), newTable("glyf")
    font["glyf"].glyphOrder, font["glyf"].glyphs = order, drawn
    del font["CFF "]
    font["maxp"].tableVersion = 0x00010000
    for field in ("maxZones", "maxTwilightPoints", "maxStorage", "maxFunctionDefs", "maxInstructionDefs"):
        setattr(font["maxp"], field, 0)
    for field in ("maxStackElements", "maxSizeOfInstructions", "maxComponentElements"):
        setattr(font["maxp"], field, 0)
    font["maxp"].maxZones = 1
    font["post"].formatType, font["post"].extraNames, font["post"].mapping = 2.0, [], {}
    font["post"].glyphOrder = order
    font.sfntVersion = "\000\001\000\000"
    return font


def with_hair_space(font: TTFont) -> TTFont:
    """Add the thin space that letters of a label stand apart by; B612 has none."""
    font["glyf"]["hairspace"] = TTGlyphPen(None).glyph()
    font["hmtx"]["hairspace"] = (HAIR_SPACE, 0)
    for table in font["cmap"].tables:
        if table.isUnicode():
            table.cmap[0x200A] = "hairspace"
    font["post"].extraNames, font["post"].mapping = [], {}
    return font


def quadratic(glyph: object) -> object:
    """One glyph, redrawn with quadratic curves to a thousandth of its height."""
    pen = TTGlyphPen(None)
    glyph.draw(Cu2QuPen(pen, max_err=1.0, reverse_direction=True))
    return pen.glyph()


def make_chinese(source: Path) -> TTFont:
    """The characters of GB 2312, which is what a newspaper needs, out of the collection; kept as cubic outlines, at half the size."""
    font = next(one for one in TTCollection(source).fonts if one["name"].getDebugName(1) == CHINESE)
    options = Options(layout_features=["kern"], hinting=False, name_IDs=[0, 1, 2, 3, 4, 5, 6, 13, 14])
    subsetter = Subsetter(options)
    subsetter.populate(unicodes=[*TEXT, *map(ord, CHINESE_SIGNS), *gb2312()])
    subsetter.subset(font)
    return font


def gb2312() -> list[int]:
    """Code points of the 6763 characters of GB 2312."""
    rows, columns = range(0xB0, 0xF8), range(0xA1, 0xFF)
    pairs = (bytes([row, column]).decode("gb2312", "ignore") for row in rows for column in columns)
    return [ord(character) for character in pairs if character]


def make_icons(source: Path) -> TTFont:
    """Outlined icons and filled ones, each at its code point in `widgets.core.icons`."""
    outlined = instance(source, 0, list(OUTLINED.values()))
    filled = instance(source, 1, [OUTLINED[name] for name in FILLED])
    glyphs = filled.getBestCmap()
    for name in FILLED:
        source_glyph, copy = glyphs[OUTLINED[name]], f"{name}.fill"
        outlined["glyf"][copy] = filled["glyf"][source_glyph]
        outlined["hmtx"][copy] = filled["hmtx"][source_glyph]
        for table in outlined["cmap"].tables:
            table.cmap[filled_code(name)] = copy
    outlined["post"].extraNames, outlined["post"].mapping = [], {}
    return outlined


def instance(source: Path, fill: int, codes: list[int]) -> TTFont:
    """The icons of `codes`, drawn with `fill` 0 or 1."""
    font = instantiateVariableFont(TTFont(source), {"FILL": fill})
    for table in ("GSUB", "GPOS", "GDEF"):  # words typed as icons are not wanted
        if table in font:
            del font[table]
    font.flavor = None
    return subset(font, codes)


def main(folder: Path) -> None:
    """Write the fonts and their licences."""
    FONTS.mkdir(exist_ok=True)
    for face in FACES:
        whole = TTFont(folder / f"b612/usr/share/fonts/opentype/b612/{face}.otf")
        with_hair_space(to_truetype(subset(whole, TEXT))).save(FONTS / f"{face}.ttf")
    for face in CHINESE_FACES:
        collection = folder / f"noto/usr/share/fonts/opentype/noto/NotoSansCJK-{face}.ttc"
        make_chinese(collection).save(FONTS / f"NotoSansSC-{face}.otf")
    make_icons(folder / "package/material-symbols-rounded.woff2").save(FONTS / "Icons.ttf")
    copy_licence(folder / "b612/usr/share/doc/fonts-b612/copyright", FONTS / "B612-LICENSE.txt")
    copy_licence(folder / "noto/usr/share/doc/fonts-noto-cjk/copyright", FONTS / "NotoSansSC-LICENSE.txt")
    copy_licence(folder / "package/LICENSE", FONTS / "Icons-LICENSE.txt")
    for path in sorted(FONTS.iterdir()):
        print(f"{path.name}: {path.stat().st_size / 1000:.1f} kB")


def copy_licence(source: Path, target: Path) -> None:
    """Copy a licence, unpacked where the package holds it compressed, without the line that tells how packages write it."""
    packed = source.with_name(source.name + ".gz")
    text = gzip.decompress(packed.read_bytes()) if packed.exists() else source.read_bytes()
    target.write_bytes(
        b"".join(line for line in text.splitlines(keepends=True) if not line.startswith(b"Format:"))
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]))
