"""The keys of robots that this handheld is paired with, and how it comes by them."""
