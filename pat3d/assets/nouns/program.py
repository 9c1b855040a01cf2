"""A noun in the shape language, read, checked and made: an entry whose recipe is data."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import QhullError

from pat3d.assets.catalogue.common import cavity, height, length
from pat3d.assets.catalogue.joinery import cut, dressed, wrapped
from pat3d.assets.catalogue.registry import RGB, Build, Entry, Style
from pat3d.assets.colours import COLOURS, find_colour
from pat3d.assets.nouns.language import LARGEST, MAX_DEPTH, MAX_HULLS, MAX_SHAPES, SCHEMA, VERBS
from pat3d.assets.nouns.verbs import MADE, stepped
from pat3d.assets.rounded import merged
from pat3d.assets.shapes import Shape
from pat3d.errors import Pat3dError, SpecError
from pat3d.scene.asset import Region
from pat3d.scene.yaml_source import Place, Source, nearest, read_yaml, validate

WITHIN = ("cut", "dressed", "wrap")
"""Verbs of other shapes, besides `join`."""


@dataclass(frozen=True, kw_only=True)
class Program:
    """A valid noun; whether its shapes join is found when it is made."""

    source: Source
    text: str
    """As written."""
    entry: Entry


def read_noun(path: Path) -> Program:
    """The noun in a YAML file.

    Raises:
        SpecError: it is invalid; the message names line, column and key.
    """
    source = read_yaml(path)
    validate(source, SCHEMA)
    document = source.document
    _check(source, document)
    return Program(
        source=source,
        text=path.read_text(encoding="utf-8"),
        entry=Entry(
            noun=document["noun"],
            recipe=lambda style: build(source, style),
            family=document.get("family", "own"),
            synonyms=tuple(document.get("names", ())),
            plurals=tuple(document.get("plurals", ())),
            material=document.get("material", "plastic"),
            colours=tuple(document.get("colours", ("gray",))),
            accents=tuple(document.get("accents", ())),
        ),
    )


def build(source: Source, style: Style) -> Build:
    """What the program of `source` makes in `style`.

    Raises:
        SpecError: a shape cannot be made with these numbers; the message names the line.
    """
    return _Maker(source, style).build()


def _check(source: Source, document: Mapping[str, Any]) -> None:
    """What a schema cannot say: names that are used are there, shapes have one verb, nothing is deeper than allowed."""
    known: list[str] = []
    for name, said in document.get("parameters", {}).items():
        if isinstance(said, dict):
            _check_length(source, ("parameters", name), said.get("value", said.get("is")), known)
        known.append(name)
    named: list[str] = []
    for name, shape in document.get("shapes", {}).items():
        _check_shape(source, ("shapes", name), shape, known, named, 1)
        named.append(name)
    for key in ("parts", "paint"):
        for at, one in enumerate(document.get(key, ())):
            _check_shape(source, (key, at, "shape"), one["shape"], known, named, 1)
            if isinstance(one["colour"], str) and find_colour(one["colour"]) is None:
                raise source.error(
                    (key, at, "colour"), f'no colour "{one["colour"]}".{nearest(one["colour"], list(COLOURS))}'
                )
    for key in ("colours", "accents"):
        for at, colour in enumerate(document.get(key, ())):
            if colour not in COLOURS:
                raise source.error((key, at), f'no colour "{colour}".{nearest(colour, list(COLOURS))}')
    for at, region in enumerate(document.get("regions", ())):
        if sum(key in region for key in ("disc", "rectangle", "cavity")) != 1:
            raise source.error(("regions", at), "give one of disc, rectangle and cavity.")
        if "cavity" not in region and ("at" not in region or "kind" not in region):
            raise source.error(("regions", at), "a disc or rectangle needs its kind (on, in) and its floor (at).")
    _check_lengths(source, (), {key: document.get(key) for key in ("regions", "anchors", "mass")}, known)


def _check_shape(
    source: Source, place: Place, shape: Mapping[str, Any], known: list[str], named: list[str], depth: int
) -> None:
    if depth > MAX_DEPTH:
        raise source.error(place, f"shapes are nested deeper than {MAX_DEPTH}.")
    verbs = [key for key in shape if key != "then"]
    if len(verbs) != 1:
        said = f"it has {' and '.join(verbs)}" if verbs else "it has none"
        raise source.error(place, f"a shape is made by one of {', '.join(VERBS)}; {said}.")
    verb = verbs[0]
    if verb == "join":
        for at, child in enumerate(shape["join"]):
            _check_shape(source, (*place, "join", at), child, known, named, depth + 1)
    elif verb == "wrap":
        _check_shape(source, (*place, "wrap"), shape["wrap"], known, named, depth + 1)
    elif verb in WITHIN:
        for key, child in shape[verb].items():
            for at, one in enumerate(child if isinstance(child, list) else [child]):
                where = (*place, verb, key, at) if isinstance(child, list) else (*place, verb, key)
                _check_shape(source, where, one, known, named, depth + 1)
    elif verb == "use":
        if shape["use"] not in named:
            raise source.error(
                (*place, "use"), f'no shape "{shape["use"]}" stands before it.{nearest(shape["use"], named)}'
            )
    else:
        _check_lengths(source, (*place, verb), shape[verb], known)
    for at, step in enumerate(shape.get("then", ())):
        (name,) = step
        if name not in ("turn", "mirror"):
            _check_lengths(source, (*place, "then", at, name), step[name], known)


def _check_lengths(source: Source, place: Place, value: Any, known: list[str]) -> None:
    """Raise for a parameter that is not there, in lengths anywhere within `value`."""
    if isinstance(value, list):
        for at, child in enumerate(value):
            _check_lengths(source, (*place, at), child, known)
    elif isinstance(value, dict):
        if value and all(isinstance(one, int | float) and not isinstance(one, bool) for one in value.values()):
            fields = {"count", "lobes", "depth", "start", "groups", "sides", "smooth", "segments", "flatness", "height",
                      "radius", "bottom", "top", "corner", "wall", "floor", "flare", "end_radius", "disc"}  # fmt: skip
            if not set(value) <= fields or set(value) & set(known):
                _check_length(source, place, value, known)
            return
        for key, child in value.items():
            if key not in ("kind", "closed"):
                _check_lengths(source, (*place, key), child, known)
    elif isinstance(value, str):
        _check_length(source, place, value, known)


def _check_length(source: Source, place: Place, value: Any, known: list[str]) -> None:
    names = (
        [value]
        if isinstance(value, str)
        else [key for key in value if key != "plus"]
        if isinstance(value, dict)
        else []
    )
    for name in names:
        if name not in known:
            raise source.error(place, f'no parameter "{name}" stands before it.{nearest(name, known)}')


class _Maker:
    """Makes one object of a program."""

    def __init__(self, source: Source, style: Style) -> None:
        self._source, self._style = source, style
        self._values: dict[str, float] = {}
        self._shapes: dict[str, Shape] = {}
        self._left = MAX_SHAPES

    def build(self) -> Build:
        document = self._source.document
        for name, said in document.get("parameters", {}).items():
            self._values[name] = self._parameter(said)
        for name, shape in document.get("shapes", {}).items():
            self._shapes[name] = self._shape(shape, ("shapes", name))
        parts = self._coloured("parts")
        hulls = sum(len(shape.hulls) for shape, _ in parts)
        if not 1 <= hulls <= MAX_HULLS:
            raise self._source.error(("parts",), f"{hulls} convex parts; 1 to {MAX_HULLS} can be simulated.")
        mass = document.get("mass")
        return Build(
            parts=tuple(parts),
            regions=tuple(self._region(one) for one in document.get("regions", ())),
            paint=tuple(self._coloured("paint")),
            anchors=tuple(self._point(one) for one in document.get("anchors", ())),
            mass=None if mass is None else self._length(mass),
        )

    def _parameter(self, said: Any) -> float:
        if not isinstance(said, dict):
            return self._style.vary(float(said))
        if "is" in said:
            return self._length(said["is"])
        draw: Callable[..., float] = {"height": height, "length": length}.get(said.get("kind", ""), _plain)
        return draw(self._style, self._length(said["value"]), said.get("spread", 0.06))

    def _coloured(self, key: str) -> list[tuple[Shape, RGB]]:
        found = []
        for at, one in enumerate(self._source.document.get(key, ())):
            found.append((self._shape(one["shape"], (key, at, "shape")), self._colour(one["colour"])))
        return found

    def _colour(self, said: Any) -> RGB:
        if isinstance(said, int):
            return self._style.colour(said)
        if isinstance(said, str):
            return COLOURS[find_colour(said) or said]
        if isinstance(said, dict):
            return self._style.shade(self._style.colour(said["of"]), said["shade"])
        red, green, blue = said
        return red, green, blue

    def _shape(self, said: Mapping[str, Any], place: Place) -> Shape:
        verb = next(key for key in said if key != "then")
        self._spend(1, place)
        try:
            if verb == "join":
                made = merged([self._shape(one, (*place, "join", at)) for at, one in enumerate(said["join"])])
            elif verb == "use":
                made = self._shapes[said["use"]]
            elif verb in WITHIN:
                made = self._within(verb, said[verb], place)
            else:
                made = MADE[verb](self._numbers(said[verb]))
            for step in said.get("then", ()):
                (name,) = step
                if name in ("line", "circle"):
                    self._spend(step[name]["count"] * max(1, len(made.hulls)), place)
                value = step[name] if name in ("turn", "mirror") else self._numbers(step[name])
                made = stepped(made, name, value)
        except SpecError:
            raise
        except (
            Pat3dError,
            ValueError,
            IndexError,
            ZeroDivisionError,
            FloatingPointError,
            np.linalg.LinAlgError,
            QhullError,
        ) as error:
            text = " ".join(str(error).split())[:160]
            raise self._source.error(place, f"this {verb} cannot be made: {text}") from error
        if np.abs(made.solid.bounding_box()).max(initial=0.0) > LARGEST and made.hulls:
            raise self._source.error(place, f"this {verb} reaches further than {LARGEST:g} m from the origin.")
        if made.solid.is_empty():
            raise self._source.error(place, f"this {verb} is empty: nothing is left, or a size is not positive.")
        return made

    def _within(self, verb: str, said: Any, place: Place) -> Shape:
        """A verb of other shapes."""
        if verb == "cut":
            holes = [self._shape(one, (*place, "cut", "holes", at)) for at, one in enumerate(said["holes"])]
            return cut(self._shape(said["of"], (*place, "cut", "of")), *holes)
        if verb == "dressed":
            return dressed(*(self._shape(said[key], (*place, "dressed", key)) for key in ("looks", "parts")))
        return wrapped(self._shape(said, (*place, "wrap")))

    def _spend(self, count: int, place: Place) -> None:
        self._left -= count
        if self._left < 0:
            raise self._source.error(place, f"more than {MAX_SHAPES} shapes, copies counted.")

    def _numbers(self, value: Any) -> Any:
        """`value` with every length in it as a number."""
        if isinstance(value, bool) or value is None:
            return value
        if isinstance(value, int | float | str):
            return self._length(value)
        if isinstance(value, list):
            return [self._numbers(child) for child in value]
        if value and set(value) <= self._values.keys() | {"plus"}:
            return self._length(value)
        return {key: self._numbers(child) for key, child in value.items()}

    def _length(self, value: Any) -> float:
        if isinstance(value, str):
            return self._values[value]
        if isinstance(value, dict):
            return float(
                sum(factor * (1.0 if name == "plus" else self._values[name]) for name, factor in value.items())
            )
        return value

    def _point(self, value: Sequence[Any]) -> tuple[float, float, float]:
        x, y, z = (float(self._length(one)) for one in value)
        return x, y, z

    def _region(self, said: Mapping[str, Any]) -> Region:
        if "cavity" in said:
            made = said["cavity"]
            inner = [(float(r), float(z)) for r, z in self._numbers(made["inner"])]
            return cavity(inner, made.get("segments", 12), self._numbers(made.get("levels", [])))
        disc = "disc" in said
        half = (self._length(said["disc"]),) * 2 if disc else tuple(self._length(one) / 2 for one in said["rectangle"])
        return Region(
            kind=said["kind"],
            shape="disc" if disc else "rectangle",
            floor=self._point(said["at"]),
            half_size=(float(half[0]), float(half[1])),
            height=float(self._length(said["height"])) if "height" in said else float("inf"),
            enclosed=said.get("enclosed", False),
        )


def _plain(style: Style, value: float, spread: float) -> float:
    return style.vary(value, spread)
