"""The handheld's end of the socket."""
