"""Switch access: one or two switches reach everything on the window by a mark that steps over it."""
