"""What the platform lets be copied and pasted."""

class ClipboardBase:
    def copy(self, data: str = ...) -> None: ...
    def paste(self) -> str: ...

Clipboard: ClipboardBase
