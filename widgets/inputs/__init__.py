"""Keys, pads, switches, shakes and voices, as pictures and tests."""
