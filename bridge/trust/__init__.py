"""Keys: how a robot and its clients come to know each other, as both ends read it."""
