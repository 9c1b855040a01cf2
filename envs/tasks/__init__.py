"""Tasks: what to do in a scene, when it is done, and what the hand has to get to."""
