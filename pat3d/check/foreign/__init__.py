"""Scenes that are not ours: read from MJCF, URDF, SDF or USD, and asked the questions that ours are asked."""
