"""The services of a station, with their preconditions and the ledger of what was done once."""
