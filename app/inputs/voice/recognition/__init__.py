"""From sound to a phrase of the grammar."""
