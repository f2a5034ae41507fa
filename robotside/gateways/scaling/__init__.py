"""Less of a picture or a message, for a client that asks for less or has a slow link."""
