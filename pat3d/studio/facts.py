"""What a studio says of a scene and its objects, in Markdown."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from pat3d.scene.model import SceneObject
from pat3d.studio.session import Session
from pat3d.studio.workbench import Order

LATEST = 20
"""Orders that are listed."""

_SPECIAL = str.maketrans({one: f"\\{one}" for one in "\\`*_{}[]()<>#+-!|:@~"})


def plain(words: str) -> str:
    """Words that Markdown shows as they are, on one line."""
    return " ".join(words.split()).translate(_SPECIAL)


def table(session: Session) -> str:
    """A row for every object."""
    drifts = _drifts(session.verification)
    rows = ["| object | kg | friction | rests on | drift |", "| --- | --- | --- | --- | --- |"]
    for obj in session.scene.objects:
        name = plain(obj.name)
        drift = drifts.get(obj.name)
        cells = (
            f"**{name}**" if obj.name == session.selected else name,
            f"{obj.asset.mass_properties.mass:.3g}",
            f"{obj.asset.material.friction:g}",
            plain(_support(session, obj)),
            "" if drift is None else f"{drift[0]:.3f} mm",
        )
        rows.append(f"| {' | '.join(cells)} |")
    return "\n".join(rows)


def about(session: Session) -> str:
    """The selected object, a line for each fact; empty where none is selected."""
    if session.selected is None:
        return ""
    obj, asset = session.scene[session.selected], session.scene[session.selected].asset
    facts = {
        "asked for as": obj.phrase or "-",
        "rests on": _support(session, obj),
        "mass": f"{asset.mass_properties.mass:.3g} kg",
        "material": f"{asset.material.name}, friction {asset.material.friction:g}",
        "size": " x ".join(f"{100 * side:.1f}" for side in asset.size) + " cm",
        "position": ", ".join(f"{value:.3f}" for value in obj.pose.position) + " m",
        "convex parts": str(len(asset.parts)),
        **_found(session, obj.name),
        "from": _origin(asset.provenance),
    }
    lines = [f"**{plain(obj.name)}**", *(f"- {what}: {plain(value)}" for what, value in facts.items())]
    return "\n".join(lines)


def changed(session: Session) -> str:
    """What the edits changed, a row for every object that moved; empty where they are not settled."""
    changes = session.current.changes
    if changes is None:
        return ""
    lines = [f"Added: {plain(', '.join(changes.added))}"] if changes.added else []
    lines += [f"Removed: {plain(', '.join(changes.removed))}"] if changes.removed else []
    moved = sorted(changes.moved.items(), key=lambda one: -one[1].mm)
    rows = [f"| {plain(name)} | {one.mm:.2f} | {one.degrees:.2f} |" for name, one in moved]
    return "\n".join(
        [*(f"- {line}" for line in lines), "", "| moved by | mm | degrees |", "| --- | --- | --- |", *rows]
    )


def orders(found: Sequence[Order]) -> str:
    """What was ordered, the latest first."""
    return "\n".join(
        f"- {plain(one.title)}: **{one.state}**{f', {plain(one.said)}' if one.said else ''}"
        for one in found[: -LATEST - 1 : -1]
    )


def verdict(session: Session) -> str:
    """Whether the scene is verified, and by how much."""
    found = session.verification
    if not found:
        if session.at_rest:
            return "Its folder has no report of a verification."
        waiting = len(session.current.edits)
        return f"{waiting} edit{'s' if waiting > 1 else ''} to be settled: {plain('; '.join(_said(session)))}"
    certificate = _part(found, "certificate")
    lines = ["**Verified**: it does not move." if found.get("passed") else "**Fails its verification.**"]
    tilt, worst = certificate.get("largest_tilt"), certificate.get("worst")
    if isinstance(tilt, int | float):
        first = ", ".join(map(str, certificate.get("first_to_go") or ()))
        lines.append(f"It stands a tilt of {tilt:.2f} degrees{plain(f'; first to go: {first}') if first else ''}.")
    if isinstance(worst, int | float):
        lines.append(f"Unbalanced: {worst:.1g} of a weight.")
    lines += [plain(str(line)) for line in found.get("failures") or ()]
    return "  \n".join(lines)


def _said(session: Session) -> list[str]:
    return [str(edit) for edit in session.current.edits]


def _support(session: Session, obj: SceneObject) -> str:
    return "fixed" if obj.fixed else ", ".join(session.scene.carriers(obj.name))


def _found(session: Session, name: str) -> dict[str, str]:
    """What the checks found of one object."""
    verification, facts = session.verification, {}
    certificate = _part(verification, "certificate")
    residual = _part(certificate, "residuals").get(name)
    if isinstance(residual, int | float):
        facts["unbalanced"] = f"{residual:.1g} of its weight"
    tilt = certificate.get("largest_tilt")
    if isinstance(tilt, int | float):
        goes = name in (certificate.get("first_to_go") or ())
        facts["margin"] = f"{'goes first beyond' if goes else 'stands more than'} {tilt:.2f} degrees of tilt"
    drift = _drifts(verification).get(name)
    if drift is not None:
        facts["drift in MuJoCo"] = f"{drift[0]:.3f} mm, {drift[1]:.3f} degrees"
    return facts


def _drifts(verification: Mapping[str, Any]) -> dict[str, tuple[float, float]]:
    """Of every object, of its centre of mass [mm] and [degrees]."""
    found = {}
    objects = _part(verification, "mujoco").get("objects")
    for one in objects if isinstance(objects, list | tuple) else ():
        if isinstance(one, dict):
            name, mm, degrees = one.get("name"), one.get("centre_mm"), one.get("degrees")
            if isinstance(mm, int | float) and isinstance(degrees, int | float):
                found[str(name)] = float(mm), float(degrees)
    return found


def _part(document: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    found = document.get(key)
    return found if isinstance(found, Mapping) else {}


def _origin(provenance: Mapping[str, Any]) -> str:
    source = str(provenance.get("source", "unknown"))
    named = provenance.get("file") or provenance.get("noun")
    return f"{source}: {named}" if named else source
