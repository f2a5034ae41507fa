"""A dialogue over everything else in the window."""

from kivy.uix.anchorlayout import AnchorLayout

class ModalView(AnchorLayout): ...
