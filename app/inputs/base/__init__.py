"""Parts that all input methods share."""
