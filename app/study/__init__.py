"""The response log, the study and the questionnaires."""
