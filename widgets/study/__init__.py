"""Prompts, questionnaires and charts of the response study."""
