"""Instructions whose colour takes the place of what is below, unmixed: nothing below is read for a picture that lets nothing through.

plain = Unblended()
plain.add_part(Rectangle(texture=frame))
"""

from __future__ import annotations

from kivy.graphics import Callback, Instruction, InstructionGroup
from kivy.graphics.opengl import GL_BLEND, glDisable, glEnable

__all__ = ["Unblended"]


class Unblended(InstructionGroup):
    """For what covers its place whole, without smooth edges; what is drawn after it is blended again."""

    def __init__(self) -> None:
        super().__init__()
        # a rule makes its instructions within its canvas, to which they would add themselves
        self._begin, self._end = Callback(self._stop, noadd=True), Callback(self._start, noadd=True)
        self.on = True
        """While it is not, its parts are blended as everything else, as a picture that fades is."""
        self.add(self._begin)
        self.add(self._end)

    def add_part(self, part: Instruction) -> None:
        """Draw `part` after those before it."""
        self.remove(self._end)
        self.add(part)
        self.add(self._end)

    def _stop(self, _: object) -> None:
        if self.on:
            glDisable(GL_BLEND)

    def _start(self, _: object) -> None:
        glEnable(GL_BLEND)
