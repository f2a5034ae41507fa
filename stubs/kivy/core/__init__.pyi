"""What Kivy takes from the platform: text, pictures, sound, the window."""
