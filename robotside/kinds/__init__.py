"""Kinds of vehicles: one record and one file for each."""
