"""Maps and the marks on them."""
