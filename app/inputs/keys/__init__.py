"""Keys of a keyboard."""
