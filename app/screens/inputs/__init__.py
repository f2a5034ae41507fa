"""The inputs screen: a list of the input methods, and beside it the pane of the one that is chosen."""
