"""What happens, by ear: tones for alarms, warnings and refusals, off until they are switched on."""
