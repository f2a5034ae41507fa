"""What all input methods share."""
