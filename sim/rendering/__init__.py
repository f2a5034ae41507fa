"""Camera pictures of a world."""
