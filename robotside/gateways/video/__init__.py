"""The camera as film: one encoding for all who want the same, cut for each of them into a file that does not end."""
