"""What was understood, who may ask for it, and what is done about it."""
