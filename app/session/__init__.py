"""Being connected to one robot: what it said, what it was asked, what is being edited."""
