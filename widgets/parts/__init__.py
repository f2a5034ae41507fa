"""The kit of buttons, rows, cards, labels and fields that widgets and screens are built of."""
