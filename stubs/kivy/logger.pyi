"""Kivy's log."""

import logging

Logger: logging.Logger
