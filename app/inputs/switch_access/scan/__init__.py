"""The scan, free of widgets: clean presses, a tree of targets, and the mark that steps over it."""
