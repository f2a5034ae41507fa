"""Graphs of nodes and topics: laid out in layers, drawn, moved by fingers."""
