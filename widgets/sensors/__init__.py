"""What a robot's sensors see around it, and any message field by field."""
