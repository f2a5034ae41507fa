"""One pane for each method's settings."""
