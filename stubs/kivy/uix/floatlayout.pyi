"""Children where their hints place them."""

from kivy.uix.layout import Layout

class FloatLayout(Layout): ...
