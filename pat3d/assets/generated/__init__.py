"""Meshes that a server makes of words or of a picture, behind the same protocol as every other source of assets."""
