from __future__ import annotations

from widgets.parts.kit import ListRow, Text
from widgets.parts.listing import Listing


def told(listing):
    return [
        (type(one), getattr(one, "title", "") or one.text) for one in reversed(listing.ids.column.children)
    ]


def test_what_it_is_filled_with_takes_the_place_of_what_was_there():
    listing = Listing(nothing="No robots.")
    listing.fill([ListRow(title="Scout")])
    listing.fill(ListRow(title=name) for name in ("Minnow", "Aqua"))
    assert told(listing) == [(ListRow, "Minnow"), (ListRow, "Aqua")]


def test_it_says_so_when_there_is_nothing():
    listing = Listing(nothing="No robots.")
    listing.fill([])
    assert told(listing) == [(Text, "No robots.")]
