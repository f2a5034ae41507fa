"""The map with points, and beside it what is done about them."""
