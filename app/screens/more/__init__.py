"""Everything that the navigation has no room for, as large tiles."""
