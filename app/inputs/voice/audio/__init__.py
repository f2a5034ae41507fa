"""Sound from the microphone: levels, noise, where an utterance begins and ends."""
