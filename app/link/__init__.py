"""The connection to one robot: its messages into the mailbox, commands out."""
