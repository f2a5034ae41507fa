"""The one way in which XML of clients is parsed: no entities, nothing from elsewhere, nothing huge."""

from __future__ import annotations

from lxml import etree

__all__ = ["strict_parser"]


def strict_parser(encoding: str | None = None) -> etree.XMLParser:
    """A parser for one message, in this `encoding` whatever the message says of itself; None believes it.

    A document type is for who parses to refuse: nothing of it is resolved here.
    """
    return etree.XMLParser(
        encoding=encoding,
        resolve_entities=False,
        no_network=True,
        load_dtd=False,
        huge_tree=False,
        remove_comments=True,
        remove_pis=True,
    )
