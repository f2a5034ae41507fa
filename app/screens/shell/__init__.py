"""The frame round every screen: top bar, rail, banner, STOP, dialogs."""
