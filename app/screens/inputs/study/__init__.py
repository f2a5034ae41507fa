"""The response log, trials and questionnaires."""
