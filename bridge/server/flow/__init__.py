"""Flow control towards one client: how much is sent, in which order, and how good its pictures are."""
