"""The handheld: link, newest message per topic, commands, mission editor, layouts, screens and recorder."""
