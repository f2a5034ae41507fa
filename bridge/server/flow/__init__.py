"""How much goes to one client, in which order, and how good its pictures are."""
