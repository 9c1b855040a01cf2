"""From a photograph to a verified scene: what it shows is measured, and made like any other scene.

prompt -> picture -> depth, masks, labels -> assets -> fits -> poses apart -> settling -> verification -> files
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace

from pat3d.assets import sources
from pat3d.assets.generated.orders import Orders
from pat3d.assets.source import AssetSource
from pat3d.assets.variant import Variant
from pat3d.errors import AssetError, PromptError, SpecError
from pat3d.generation.from_image import request_of_recovered
from pat3d.generation.pipeline import Outcome, make
from pat3d.generation.request import SceneRequest, derived_seed
from pat3d.generation.settings import Settings
from pat3d.progress import Clock, CpuBudget, Event, Progress, silent
from pat3d.scene.asset import Asset
from pat3d.scene.folder import check_target
from pat3d.scene.replacement import write_bytes
from pat3d.vision.files import Label, Labels
from pat3d.vision.looking import Looked, Lookers, Photograph, look
from pat3d.vision.observation import Observation
from pat3d.vision.occlusion import doubt_of_size, least_occluded
from pat3d.vision.painting import encoded
from pat3d.vision.recover import Recovered, recover

PICTURE = "picture.png"
"""In the scene's folder: what the photograph became, side by side."""
PAINTED = "photograph.png"
"""In the scene's folder: the photograph, where it was painted."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Understood:
    """A photograph, and what it asks for."""

    request: SceneRequest
    found: Recovered
    looked: Looked


def generate_from_image(
    photograph: Photograph,
    *,
    out: str | os.PathLike[str],
    prompt: str = "",
    settings: Settings | None = None,
    lookers: Lookers | None = None,
    libraries: Sequence[str] = (),
    orders: Orders | None = None,
    progress: Progress = silent,
) -> Outcome:
    """Make the scene that a photograph shows, verify it and write its folder.

    Args:
        photograph: with depth, masks and labels, as far as there are files of them.
        out: folder to write; an earlier scene folder there is replaced once the new one is complete.
        prompt: what the scene is called; where there is no picture, what is painted.
        settings: how to make it.
        lookers: models that say what no file does.
        libraries: to take objects from before the catalogue.
        orders: has a mesh server make what nothing else has.
        progress: told what is going on.

    Raises:
        SpecError: a file cannot be used, or neither a file nor a model says something that is needed.
        ModelError: a model gives no valid answer.
        PromptError: no asset is known for a label.
        LayoutError: the picture does not tell what is level, or an object finds no room.
        SimulationError: the layout cannot be simulated.
        CpuLimitError: the settings' limit is spent.
        ExportError: `out` cannot be written.
    """
    own = settings or Settings()
    folder, clock, budget = check_target(out), Clock(), CpuBudget(own.cpu_limit)
    watched = budget.watching(progress)
    one = understand(
        photograph,
        prompt=prompt,
        seed=own.seed,
        lookers=lookers,
        libraries=libraries,
        orders=orders,
        clock=clock,
        progress=watched,
    )
    outcome = make(one.request, folder=folder, settings=own, clock=clock, progress=watched)
    watched(Event(stage="drawing what the picture became"))
    from pat3d.view.preview import save_row
    from pat3d.vision.panels import panels

    save_row(panels(one.looked.seen, one.found, outcome.scene), folder / PICTURE)
    if photograph.picture is None:
        write_bytes(folder / PAINTED, encoded(one.looked.picture))
    return outcome


def understand(
    photograph: Photograph,
    *,
    prompt: str,
    seed: int,
    lookers: Lookers | None = None,
    libraries: Sequence[str] = (),
    orders: Orders | None = None,
    clock: Clock | None = None,
    progress: Progress = silent,
) -> Understood:
    """What a photograph shows, and the scene that it asks for; arguments and errors are those of `generate_from_image`.

    Args:
        photograph: with depth, masks and labels, as far as there are files of them.
        prompt: what the scene is called; where there is no picture, what is painted.
        seed: of the assets.
        lookers: models that say what no file does.
        libraries: to take objects from before the catalogue.
        orders: has a mesh server make what nothing else has.
        clock: of the stages.
        progress: told what is going on.
    """
    own = clock or Clock()
    with own("picture"):
        progress(Event(stage="reading the picture"))
        looked = look(photograph, lookers or Lookers(), prompt=prompt, progress=progress)
        seen, labels = looked.seen, looked.labels
    with own("assets"):
        assets = _assets(labels, seed, libraries, orders, progress)
    with own("fitting"):
        judge = None if lookers is None or lookers.judge is None else lookers.judge()
        stances = {one.name: one.stance for one in labels.objects}
        found = recover(seen, assets, stances=stances, judge=judge, progress=progress)
        found = _measured(found, labels, seen)
        found = replace(found, notes=(*looked.notes, *found.notes))
    request = request_of_recovered(
        found,
        prompt=prompt,
        phrases={one.name: one.name for one in labels.objects},
        record={
            "labels": [asdict(one) for one in labels.objects],
            "least_occluded": labels.least_occluded,
            **looked.record,
            "picture": photograph.files(),
        },
    )
    return Understood(request=request, found=found, looked=looked)


def _measured(found: Recovered, labels: Labels, seen: Observation) -> Recovered:
    """`found` in metres: those of the least occluded object where the depth has none, else compared with them."""
    sizes = {one.name: one.size for one in labels.objects if one.size is not None}
    if not labels.metric:
        return found.resized(sizes, seen, said=labels.least_occluded)
    if not sizes:
        return found
    name, _ = least_occluded(found, seen, sizes, labels.least_occluded)
    doubt = doubt_of_size(found, name, sizes[name])
    return found if doubt is None else replace(found, notes=(*found.notes, doubt))


def _assets(
    labels: Labels, seed: int, libraries: Sequence[str], orders: Orders | None, progress: Progress
) -> Mapping[str, Asset]:
    """An asset for every label, of its usual size."""
    among = sources.sources(libraries) if libraries else ()
    found: dict[str, Asset] = {}
    for number, label in enumerate(labels.objects):
        progress(Event(stage="making assets", detail=label.name, step=number, steps=len(labels.objects)))
        variant = Variant(seed=derived_seed(seed, label.name), colours=label.colours, material=label.material)
        try:
            found[label.name] = _asset(label, variant, among, orders)
        except AssetError as error:
            raise AssetError(f'"{label.name}": {error}') from error
    return found


def _asset(label: Label, variant: Variant, among: Sequence[AssetSource], orders: Orders | None) -> Asset:
    # "A chipped blue mug" is a mug: of words that nobody knows, the last ones tell what it is.
    words = label.noun.split()
    nouns = [" ".join(words[first:]) for first in range(len(words))]
    for noun in nouns:
        candidates = sources.find(noun, among)
        try:
            return sources.make(candidates[0].noun if candidates else noun, variant)
        except PromptError as error:
            if noun == nouns[-1] and orders is None:
                raise PromptError(f'nothing is known for "{label.name}": {error}') from error
    if orders is None:
        raise SpecError(f'"{label.name}" has no noun.')
    order = orders.order(label.noun)
    orders.keep([order.noun])
    return sources.make(order.noun, variant)
