"""Imported before all else: nothing works without numpy, and who has none is told which package to install."""

from .plots.needed import need

need("numpy")
