"""A box and a mug, drawn: what models would say of their photograph, for tests of whole runs."""

from __future__ import annotations

import base64
import io
import json
import math
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from PIL import Image

from pat3d.assets import sources
from pat3d.assets.variant import Variant
from pat3d.cli.photographs import labeller_of
from pat3d.generation.request import derived_seed
from pat3d.geometry.pose import Pose
from pat3d.plan.llm.chat import Chat
from pat3d.plan.llm.settings import ModelSettings
from pat3d.vision.depth import MeasuredDepth
from pat3d.vision.detection import Found
from pat3d.vision.listing import ChatLister
from pat3d.vision.looking import Lookers
from pat3d.vision.painting import ServedPainter
from tests.loopback import Reply
from tests.plan.llm_server import Server, said, serving
from tests.vision.seen import HEIGHT, WIDTH, camera_at, see

CAMERA = camera_at((0.4, -0.8, 0.6), (0.0, 0.0, 0.05))


def made(noun, name):
    """The asset that a label of that name gets: of other seeds, proportions differ."""
    return sources.make(noun, Variant(seed=derived_seed(0, name)))


THINGS = {
    "box": (made("storage box", "box"), Pose.from_yaw(0.3, (-0.1, 0.0, 0.0))),
    "mug": (made("mug", "mug"), Pose.from_yaw(2.0, (0.22, -0.05, 0.0))),
}


class Truth:
    """Finds and measures what was drawn; counts how often it is asked."""

    name = "truth"

    def __init__(self, seen):
        self.seen, self.asked = seen, 0

    def find(self, picture, phrase):
        self.asked += 1
        return [
            Found(phrase=phrase, score=0.9, mask=self.seen.instances == number)
            for number, name in enumerate(self.seen.names, start=1)
            if name == phrase
        ]

    def measure(self, picture):
        self.asked += 1
        return MeasuredDepth(depth=self.seen.depth, angle=2 * math.degrees(math.atan(WIDTH / 2 / CAMERA.pinhole.fx)))


@contextmanager
def painted_and_labelled() -> Iterator[tuple[Lookers, Server]]:
    """Real clients of a painter and a vision-language model, served on the loopback; the truth detects and measures."""
    stream = io.BytesIO()
    Image.fromarray(np.full((HEIGHT, WIDTH, 3), 120, dtype=np.uint8)).save(stream, format="PNG")
    picture = {"data": [{"b64_json": base64.b64encode(stream.getvalue()).decode()}]}
    kinds = [{"phrase": "box", "count": 1}, {"phrase": "mug", "count": 2}]
    usual = {"colours": [], "material": None, "size": 0.1}
    told = [
        usual | {"number": 1, "name": "box", "noun": "storage box"},
        usual | {"number": 2, "name": "mug", "noun": "mug"},
    ]
    replies = [
        Reply(body=json.dumps(picture).encode()),
        said({"kinds": kinds}),
        said({"objects": told, "least_occluded": 1}),
    ]
    truth = Truth(see(THINGS, CAMERA))
    with serving(*replies) as server:
        settings = ModelSettings(name="eyes", base_url=server.url, key="secret", retries=0)
        asks = Chat(settings)
        lookers = Lookers(
            painter=lambda: ServedPainter(settings),
            lister=lambda: ChatLister(asks),
            finder=lambda: truth,
            labeller=lambda: labeller_of(asks),
            depth=lambda: truth,
        )
        yield lookers, server
