"""Everything a robot publishes, field by field."""
