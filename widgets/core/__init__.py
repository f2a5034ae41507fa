"""What every widget stands on: states and ages, themes, shapes, ink on a canvas, arithmetic."""
