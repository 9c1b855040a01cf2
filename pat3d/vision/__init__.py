"""From a picture with depth and masks to objects at poses: the geometry, and the models that give it pictures."""
