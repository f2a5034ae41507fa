"""A robot behind somebody else's rosbridge server, at the same port as one of ours."""
