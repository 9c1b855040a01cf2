"""Writes a COLLADA, 3MF or FBX file as GLB, in a process of its own, since bad input makes parsers crash or grow.

    python -P -m pat3d.assets.mesh.convert_worker INPUT OUTPUT.glb OUTPUT.json ROOT SECONDS

Coordinates stay in the file's units and axes. The JSON says those: `metres` a unit, the axis that points `up`, and
`notes`; or an `error`. Pictures are read below ROOT alone. The system ends it after SECONDS of processor time.
"""

from __future__ import annotations

import json
import os
import sys
import zipfile
from io import BytesIO
from pathlib import Path
from typing import Any
from xml.parsers import expat

from pat3d.assets.mesh.load import MAX_BYTES, MAX_FACES, make_resolver
from pat3d.errors import AssetError

MEMORY = 8 * 2**30
"""[bytes] that the process may take; a file over the limits is refused before."""

MOST_PLACED = 10_000

METRES_3MF = {
    "micron": 1e-6, "millimeter": 1e-3, "centimeter": 1e-2, "inch": 0.0254, "foot": 0.3048, "meter": 1.0,
}  # fmt: skip
"""Units of 3MF files; millimetres where the file says none."""

_COLOURS_3MF = ("basematerials", "colorgroup", "texture2dgroup")
_FACES_DAE = ("triangles", "polylist", "polygons", "tristrips", "trifans")


def main(source: Path, target: Path, root: Path) -> dict[str, Any]:
    """Convert the file `source` to the GLB `target`; returns what the JSON says."""
    resolver = make_resolver(source, root)
    scene, said = {".dae": _dae, ".3mf": _3mf, ".fbx": _fbx}[source.suffix.lower()](source, resolver)
    if not scene.geometry:
        raise AssetError("it holds no triangles")
    target.write_bytes(scene.export(file_type="glb"))
    opened = [str(path) for path in resolver.opened]
    return {**said, "notes": [*said["notes"], *resolver.refused], "opened": opened}


def _dae(source: Path, resolver: Any) -> tuple[Any, dict[str, Any]]:
    """By trimesh and pycollada."""
    import trimesh

    data = source.read_bytes()
    found = {"unit": 1.0, "up": "Y_UP"}
    inside: list[str] = []

    def begin(name: str, given: dict[str, str]) -> None:
        inside.append(name)
        if name == "unit":
            found["unit"] = float(given.get("meter", 1.0))
        if name in _FACES_DAE:
            found["faces"] = int(found.get("faces", 0)) + int(given.get("count", 0))

    def text(words: str) -> None:
        if inside[-1:] == ["up_axis"] and words.strip():
            found["up"] = words.strip()

    _scan(data, begin, lambda _: inside.pop(), text)
    _check_faces(int(found.get("faces", 0)))
    scene = trimesh.load_scene(BytesIO(data), file_type="dae", resolver=resolver, process=False)
    for geometry in scene.geometry.values():
        # COLLADA's materials say no roughness; what trimesh makes of their shininess is a guess.
        material = getattr(geometry.visual, "material", None)
        if material is not None:
            material.roughnessFactor = material.metallicFactor = None
    up = {"X_UP": "x", "Y_UP": "y", "Z_UP": "z"}.get(str(found["up"]))
    if up is None:
        raise AssetError(f'its up_axis is "{found["up"]}"; valid are X_UP, Y_UP and Z_UP')
    return scene, {"metres": _positive(found["unit"]), "up": up, "notes": []}


def _3mf(source: Path, resolver: Any) -> tuple[Any, dict[str, Any]]:
    """By trimesh and lxml; the shape alone."""
    import trimesh

    data = source.read_bytes()
    with zipfile.ZipFile(BytesIO(data)) as archive:
        entries = archive.infolist()
        if sum(entry.file_size for entry in entries) > MAX_BYTES:
            raise AssetError(f"it unpacks to more than {MAX_BYTES / 1e6:.0f} MB")
        models = [archive.read(entry) for entry in entries if entry.filename.lower().endswith(".model")]
    found: dict[str, Any] = {"unit": "millimeter", "faces": 0, "colours": False}
    holds: dict[str, list[str]] = {"": []}
    inside = [""]

    def begin(name: str, given: dict[str, str]) -> None:
        tag = name.rpartition(":")[2]
        if tag == "object":
            inside[0] = given.get("id", "?")
            holds[inside[0]] = []
        if tag in ("component", "item"):
            holds["" if tag == "item" else inside[0]].append(given.get("objectid", "?"))
        if tag == "model":
            found["unit"] = given.get("unit", found["unit"])
        found["faces"] += tag == "triangle"
        found["colours"] |= tag in _COLOURS_3MF

    for model in models:
        _scan(model, begin)
    _check_faces(found["faces"])
    _check_placed(holds)
    if found["unit"] not in METRES_3MF:
        raise AssetError(f'its unit is "{found["unit"]}"; valid are {", ".join(METRES_3MF)}')
    scene = trimesh.load_scene(BytesIO(data), file_type="3mf", process=False)
    notes = ["the colours of a 3MF file were left out"] if found["colours"] else []
    return scene, {"metres": METRES_3MF[found["unit"]], "up": "z", "notes": notes}


def _fbx(source: Path, resolver: Any) -> tuple[Any, dict[str, Any]]:
    """By ufbx."""
    from pat3d.assets.mesh.fbx import read_fbx

    scene, metres, up, notes = read_fbx(source, resolver)
    return scene, {"metres": _positive(metres), "up": up, "notes": notes}


def _scan(data: bytes, begin: Any, end: Any = None, text: Any = None) -> None:
    """Let expat tell of every element of an XML file, which may declare no document type, and so no entities."""
    parser = expat.ParserCreate()
    depth = 0

    def refuse(*_: Any) -> None:
        raise AssetError("it declares a document type, which is not read")

    def start(name: str, given: dict[str, str]) -> None:
        nonlocal depth
        depth += 1
        if depth > 200:
            raise AssetError("its elements are more than 200 deep")
        begin(name, given)

    def stop(name: str) -> None:
        nonlocal depth
        depth -= 1
        if end is not None:
            end(name)

    parser.StartDoctypeDeclHandler = refuse
    parser.StartElementHandler = start
    parser.EndElementHandler = stop
    if text is not None:
        parser.CharacterDataHandler = text
    parser.Parse(data, True)


def _check_faces(faces: int) -> None:
    if faces > MAX_FACES:
        raise AssetError(f"it has {faces:,} faces; at most {MAX_FACES:,} are read. Simplify it first")


def _check_placed(holds: dict[str, list[str]]) -> None:
    """Refuse objects that hold one another so often that a few lines of a file place more than any scene has."""
    placed: dict[str, int] = {}
    waiting = [("", False)]
    while waiting:
        name, known = waiting.pop()
        if name in placed and not known:
            if not placed[name]:
                raise AssetError(f'the object "{name}" holds itself')
            continue
        if known:
            placed[name] = max(1, sum(placed[one] for one in holds.get(name, [])))
            if placed[name] > MOST_PLACED:
                raise AssetError(f"it places more than {MOST_PLACED:,} objects")
            continue
        placed[name] = 0
        waiting.append((name, True))
        waiting += [(one, False) for one in dict.fromkeys(holds.get(name, []))]


def _positive(metres: float) -> float:
    if not 0.0 < metres < 1e6:
        raise AssetError(f"its unit is {metres:g} m")
    return metres


def limit(seconds: int) -> None:
    """Let the system end this process after `seconds` of processor time, and give it no more than MEMORY."""
    import resource

    # The second number is for what ignores the signal that comes at the first.
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 2))
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


if __name__ == "__main__":
    limit(int(sys.argv[5]))
    try:
        answer = main(Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[4]))
    except ImportError:
        answer = {"missing": True}
    except Exception as error:
        # Parsers raise whatever a malformed file makes them hit; the user needs one line.
        words = " ".join(str(error).split())[:200]
        answer = {"error": words if isinstance(error, AssetError) else f"{type(error).__name__} {words}"}
    Path(sys.argv[3]).write_text(json.dumps(answer), encoding="utf-8")
    # The parsers' own clearing up can crash, see `fbx`.
    os._exit(0)
