import numpy as np

from pat3d.view.textures import TextureAtlas, nearest_texels
from pat3d.view.tone import decode


def test_the_middle_of_a_texel_has_its_colour():
    rng = np.random.default_rng(0)
    images = [rng.integers(0, 256, (3, 5, 3), dtype=np.uint8), rng.integers(0, 256, (4, 2, 3), dtype=np.uint8)]
    atlas = TextureAtlas(images)
    for number, image in enumerate(images):
        height, width = image.shape[:2]
        row, column = (index.ravel() for index in np.indices((height, width)))
        uv = np.stack([(column + 0.5) / width, 1.0 - (row + 0.5) / height], axis=1).astype(np.float32)
        found = atlas.colour(np.full(len(uv), number, dtype=np.int32), uv, np.ones(len(uv), dtype=np.float32))
        np.testing.assert_allclose(found, decode(image[row, column] / 255.0), atol=1e-5)


def test_between_two_texels_is_their_mean():
    image = np.array([[[0, 0, 0], [255, 255, 255]]], dtype=np.uint8)
    found = TextureAtlas([image]).colour(
        np.zeros(2, dtype=np.int32), np.array([[0.5, 0.5], [0.0, 0.5]], dtype=np.float32), np.ones(2, dtype=np.float32)
    )
    np.testing.assert_allclose(found, [[0.5] * 3, [0.0] * 3], atol=1e-6)


def test_nearest_texels_repeat_and_count_from_the_top():
    image = np.arange(6, dtype=np.float32).reshape(2, 3, 1)
    uv = np.array([[0.1, 0.1], [0.9, 0.1], [0.1, 0.9], [1.1, -0.9], [-0.1, 1.9]], dtype=np.float32)
    assert nearest_texels(image, uv).ravel().tolist() == [0.0, 2.0, 3.0, 0.0, 5.0]
