"""Parts that widgets and screens are built of: buttons, rows, cards, labels, fields."""
