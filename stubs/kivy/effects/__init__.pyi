"""What a scroll does at its ends."""
