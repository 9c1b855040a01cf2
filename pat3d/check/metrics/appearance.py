"""How well pictures of a scene show its prompt: the columns of the paper's Table 1 that neural networks fill.

A measure whose network is not there is absent, with the reason; it is never a number.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from pat3d.check.metrics.subject import Subject
from pat3d.errors import CheckError, ModelError
from pat3d.plan.llm.critic import Picture
from pat3d.progress import Event, Progress, silent

DEPRESSIONS = (0.0, 20.0, 45.0)
"""Of the cameras below the horizontal [degrees]."""
AZIMUTHS = tuple(60.0 * k for k in range(6))
"""Of the cameras, counter-clockwise from the front [degrees]."""
SIDE = 448
"""Width and height of a picture [pixel]."""

Judge = Callable[[str, Sequence[Picture]], float]
"""Score of pictures that should show a prompt."""


@dataclass(frozen=True, kw_only=True)
class Score:
    """One measure."""

    value: float | None
    """None where it is absent."""
    by: str = ""
    """The network."""
    absent: str = ""
    """Why it is."""


@dataclass(frozen=True, kw_only=True)
class Appearance:
    """The three measures of one scene; those that were not asked for are None."""

    name: str
    clip: Score | None = None
    """100 times the cosine between picture and prompt, mean of all views."""
    vqa: Score | None = None
    """Probability of "yes" to whether the picture shows the prompt, mean of all views."""
    plausibility: Score | None = None
    """How plausible the scene is to a vision-language model, 0 to 100."""

    def as_dict(self) -> dict[str, Any]:
        """Plain data for a report."""
        return asdict(self)


def views(subject: Subject, *, side: int) -> tuple[Picture, ...]:
    """18 pictures of the delivered surfaces on the ground, each of which shows everything."""
    from PIL import Image

    from pat3d.view.render import frame_items, render

    items = [(body.visual, body.pose) for body in subject.bodies]
    pictures = []
    for depression in DEPRESSIONS:
        for azimuth in AZIMUTHS:
            camera = frame_items(items, aspect=1.0, azimuth=azimuth, elevation=depression)
            file = io.BytesIO()
            Image.fromarray(render(items, camera=camera, width=side, height=side)).save(file, format="PNG")
            caption = f"{azimuth:g} degrees round from the front, {depression:g} degrees above"
            pictures.append(Picture(caption=caption, png=file.getvalue()))
    return tuple(pictures)


def appearance(
    subject: Subject,
    *,
    clip: Callable[[], tuple[str, Judge]] | None = None,
    vqa: Callable[[], tuple[str, Judge]] | None = None,
    plausibility: Callable[[], tuple[str, Judge]] | None = None,
    progress: Progress = silent,
) -> Appearance:
    """The measures whose judges are given; a judge is called for its name and itself when it is needed."""
    asked = {"clip": clip, "vqa": vqa, "plausibility": plausibility}
    pictures: tuple[Picture, ...] = ()
    found: dict[str, Score] = {}
    for measure, judge in asked.items():
        if judge is None:
            continue
        if not subject.prompt:
            found[measure] = Score(value=None, absent="nobody says what the scene is to show: --prompt")
            continue
        try:
            by, score = judge()
            if not pictures:
                progress(Event(stage="drawing", detail=f"{subject.name}: {len(DEPRESSIONS) * len(AZIMUTHS)} views"))
                pictures = views(subject, side=SIDE)
            progress(Event(stage="judging", detail=f"{subject.name}: {measure}"))
            found[measure] = Score(value=score(subject.prompt, pictures), by=by)
        except (CheckError, ModelError) as error:
            found[measure] = Score(value=None, absent=str(error))
    return Appearance(name=subject.name, **found)
