"""The usage sheet of a robot: how it is reached and used by all that runs, as a page and as text."""
