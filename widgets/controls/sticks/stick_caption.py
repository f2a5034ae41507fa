"""Caption of a stick: the meaning of a push, in a word or two below the knob.

class Lever(Captioned):
    caption_drop = 40
"""

from __future__ import annotations

from kivy.graphics.texture import Texture
from kivy.lang import Builder
from kivy.metrics import sp
from kivy.properties import AliasProperty, StringProperty

from widgets.controls.sticks.stick import Stick
from widgets.core.base import text_texture
from widgets.core.theme import theme

__all__ = ["Captioned"]

Builder.load_string("""
<Captioned>:
    canvas.after:
        Rounded:
            rgba: theme.surface if root.captioned else (0, 0, 0, 0)
            pos: root.words_pos[0] - dp(4), root.words_pos[1] + dp(1)
            size: root.words_size[0] + dp(8), root.words_size[1] - dp(2)
            radius: [dp(4)]
        Tinted:
            rgba: theme.muted if root.captioned else (0, 0, 0, 0)
            texture: root.words
            size: root.words_size
            pos: root.words_pos
""")


class Captioned(Stick):
    """A stick whose caption stands below the knob, `caption_drop` under the middle."""

    caption = StringProperty("")
    """What pushing it means, where that is not to drive and to turn, as in `climb · turn`."""

    @property
    def caption_drop(self) -> float:
        """From the stick's middle down to the caption's [px]."""
        raise NotImplementedError(f"{type(self).__name__} does not say where its caption is")

    def _captioned(self) -> bool:
        return bool(self.caption) and self.forward >= 0

    captioned = AliasProperty(_captioned, bind=["caption", "forward"], cache=True)
    """The caption is visible: not while the knob is pulled over it."""

    def _words(self) -> Texture:
        return text_texture(self.caption, sp(13), theme.font)

    words = AliasProperty(_words, bind=["caption"], cache=True)
    """The caption."""

    def _words_size(self) -> tuple[float, float]:
        return self.words.size

    words_size = AliasProperty(_words_size, bind=["words"], cache=True)
    """[px]; kv does not see a texture's size change."""

    def _words_pos(self) -> tuple[float, float]:
        middle = self.center_y - self.caption_drop
        return self.center_x - self.words.width / 2, middle - self.words.height / 2

    words_pos = AliasProperty(_words_pos, bind=["words", "pos", "size"], cache=True)
    """[px]"""
