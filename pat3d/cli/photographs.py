"""The models that look at a photograph, as a command line, the environment and `pat3d.toml` name them."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

from pat3d.cli.reading import chat
from pat3d.errors import ModelError

if TYPE_CHECKING:
    from pat3d.plan.llm.chat import Chat
    from pat3d.vision.dependencies import Judge
    from pat3d.vision.depth import DepthModel
    from pat3d.vision.detection import Finder
    from pat3d.vision.labelling import Labeller
    from pat3d.vision.listing import Lister
    from pat3d.vision.looking import Lookers
    from pat3d.vision.painting import Painter


Asks = TypeVar("Asks")


def lookers_of(options: argparse.Namespace) -> Lookers:
    """A model for everything that no file says.

    Raises:
        ModelError: one that will be needed is not set up; all that are missing are named at once.
    """
    from pat3d.vision.looking import Lookers
    from pat3d.vision.models import EXAMPLES, VARIABLES, vision_models
    from pat3d.vision.painting import MODEL, URL, image_settings

    named, painter = vision_models(), image_settings()
    missing: list[str] = []
    paints_too = options.paint or options.inpaint
    if paints_too and painter is None:
        missing.append(f"nothing paints: set {MODEL} (and {URL}), or [image] name in pat3d.toml")
    if (options.masks is None or options.inpaint) and named.segmentation is None:
        missing.append(
            f"no model finds objects (--masks is missing, or --inpaint): set {VARIABLES['segmentation']} and "
            f"{VARIABLES['detection']} (such as {EXAMPLES['segmentation']} and {EXAMPLES['detection']})"
        )
    if options.depth is None and named.depth is None:
        missing.append(
            f"--depth is missing, and no model measures it: set {VARIABLES['depth']} (such as {EXAMPLES['depth']})"
        )
    if options.labels is None:
        try:
            chat()
        except ModelError as error:
            missing.append(f"--labels is missing, and no model says what the masks show: {str(error).rstrip('.')}")
    if missing:
        raise ModelError(f"{'; '.join(missing)}. pat3d doctor shows what is set up.")

    def paints() -> Painter:
        from pat3d.vision.painting import ServedPainter

        settings = image_settings()
        if settings is None:
            raise ModelError(f"nothing paints: set {MODEL}.")
        return ServedPainter(settings)

    def finds() -> Finder:
        from pat3d.vision.detection import finder_named

        return finder_named(named.detection, named.segmentation)

    def measures() -> DepthModel:
        from pat3d.vision.depth import TransformersDepth

        if named.depth is None:
            raise ModelError(f"nothing measures depth: set {VARIABLES['depth']}.")
        return TransformersDepth(named.depth)

    return Lookers(
        painter=paints if paints_too else None,
        finder=finds if options.masks is None or options.inpaint else None,
        depth=measures if options.depth is None else None,
        lister=_asking(lister_of) if options.labels is None else None,
        labeller=_asking(labeller_of) if options.labels is None else None,
        completes=options.inpaint,
        judge=_asking(judge_of) if options.labels is None else None,
    )


def painting_lookers() -> Lookers:
    """A model for everything about a photograph that is painted.

    Raises:
        ModelError: one is not set up; all that are missing are named at once.
    """
    return lookers_of(argparse.Namespace(paint=True, inpaint=False, masks=None, depth=None, labels=None))


def lister_of(asked: Chat) -> Lister:
    """Says what is in a picture."""
    from pat3d.vision.listing import ChatLister

    return ChatLister(asked)


def judge_of(asked: Chat) -> Judge:
    """Says what stands on what."""
    from pat3d.vision.dependencies import ChatJudge

    return ChatJudge(asked)


def labeller_of(asked: Chat) -> Labeller:
    """Says what masks show, in words of the catalogue."""
    from pat3d.assets.catalogue import lookup
    from pat3d.assets.colours import COLOURS
    from pat3d.assets.materials import material_names
    from pat3d.vision.labelling import ChatLabeller

    nouns = [one.noun for one in lookup.entries()]
    return ChatLabeller(asked, nouns, materials=material_names(), colours=tuple(COLOURS))


def _asking(make: Callable[[Chat], Asks]) -> Callable[[], Asks]:
    return lambda: make(chat())
