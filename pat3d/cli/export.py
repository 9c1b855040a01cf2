"""`pat3d export`: a scene folder, a mesh, or a folder of meshes in the formats of other programs."""

from __future__ import annotations

import argparse
import time
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pat3d.cli.console import console, verdict, watch
from pat3d.cli.json_output import JSON, print_facts
from pat3d.cli.options import command, option
from pat3d.errors import Pat3dError, SpecError
from pat3d.exporters.compare import ParityReport, parity
from pat3d.exporters.formats import FORMATS, VIEWS, chosen, has_usd
from pat3d.exporters.formats import export as write_formats
from pat3d.exporters.urdf.mesh_paths import MESH_PATHS, check_mesh_paths, set_mesh_paths
from pat3d.progress import Event
from pat3d.scene.checksums import record_checksums

if TYPE_CHECKING:
    from pat3d.generation.asset_export import ExportedAsset

_MESHES = "meshes only"

_MESH_OPTIONS = (
    option("--mass", "mass of the object", type=float, metavar="KG", group=_MESHES, rival="weight"),
    option("--density", "density of the closed surface", type=float, metavar="KG/M3", group=_MESHES, rival="weight"),
    option(
        "--masses",
        "CSV file of the masses of a folder of meshes, a row each: name,kg",
        metavar="TABLE.csv",
        group=_MESHES,
        rival="weight",
    ),
    option("--material", "for density and friction", metavar="NAME", group=_MESHES, shown="plastic"),
    option("--friction", "friction coefficient", type=float, metavar="MU", group=_MESHES, shown="the material's"),
    option("--units", "of the file: m, cm, mm, in", metavar="UNIT", group=_MESHES, shown="m"),
    option("--scale", "factor on the file's coordinates", type=float, group=_MESHES),
    option("--size", "longest side, instead of units and scale", type=float, metavar="M", group=_MESHES),
    option(
        "--up",
        "the file's axis that points up: z, -y, ...",
        metavar="AXIS",
        group=_MESHES,
        shown="y for glTF, else z",
    ),
    option("--parts", "convex parts by coacd, hull or box", metavar="HOW", group=_MESHES, shown="coacd"),
    option(
        "--threshold", "concavity that coacd may leave, 0.01 to 1", type=float, group=_MESHES, shown="0.05 or finer"
    ),
    option("--max-hulls", "most convex parts by coacd", type=int, metavar="N", group=_MESHES, shown="80"),
    option(
        "--decomposition-limit",
        "processor time for coacd, each mesh",
        type=float,
        metavar="SECONDS",
        group=_MESHES,
        shown="120",
    ),
    option("--thickness", "of the walls of an open shell", type=float, metavar="M", group=_MESHES),
)
"""Arguments of `import_mesh`, which knows their defaults."""


@command(
    option("source", "a scene folder, a mesh file, or a folder of meshes", metavar="SOURCE"),
    option("--out", "where to write; each format has its folder", metavar="FOLDER", required=True),
    option(
        "--formats",
        f"{', '.join(FORMATS)} for simulators, html and glb to look at, simready for NVIDIA's asset libraries",
        nargs="+",
        metavar="FORMAT",
        shown="all for simulators",
    ),
    option("--usda", "USD as text, scene.usda", action="store_true"),
    option("--usdz", "USD also in one file, scene.usdz", action="store_true"),
    option(
        "--mesh-paths",
        f"how URDF files name their meshes: {', '.join(MESH_PATHS)}",
        metavar="HOW",
        shown=MESH_PATHS[0],
    ),
    option(
        "--max-triangles",
        "most triangles of what is seen of an object; more are made a coarser level of detail",
        type=int,
        metavar="N",
        shown="as they are",
    ),
    option(
        "--usd-levels",
        "coarser levels of detail in USD, as variants: most triangles of each, with commas between",
        metavar="N,N",
        shown="the full one alone",
    ),
    *_MESH_OPTIONS,
    JSON,
    examples="""
    pat3d export scenes/desk --formats mjcf,usd,urdf --out exports/desk
    pat3d export scenes/desk --formats usd --usda --usdz --out exports/desk
    pat3d export scenes/desk --formats urdf --mesh-paths absolute --out exports/desk      for Pinocchio
    pat3d export scenes/desk --max-triangles 2000 --out exports/desk_light          scans for many copies on a GPU
    pat3d export scenes/desk --formats usd --usd-levels 5000,1000 --out exports/desk    choice "lod" of each object
    pat3d export scenes/desk --formats html,glb --out exports/desk         one file that opens in any browser
    pat3d export scenes/desk --formats simready --out exports/desk        assets with thumbnails and metadata
    pat3d export mug.glb --mass 0.3 --out assets/mug                   one mesh: repaired, decomposed, dropped
    pat3d export mug.glb --max-hulls 40 --decomposition-limit 60 --out assets/mug
    pat3d export scans/ --masses masses.csv --out assets               with a row "mug,0.31" for scans/mug.obj
    pat3d export scans/ --material ceramic --units mm --out assets     every mesh of a folder
    """,
)
def export(options: argparse.Namespace) -> int:
    """`pat3d export`."""
    source, out = Path(options.source).expanduser(), Path(options.out).expanduser()
    formats, notes = _formats(options.formats)
    usd = {"text": options.usda, "package": options.usdz, "levels": _levels(options.usd_levels)}
    mesh_paths = check_mesh_paths(options.mesh_paths or MESH_PATHS[0])
    names = (one.name.removeprefix("--").replace("-", "_") for one in _MESH_OPTIONS)
    mesh = {name: value for name in names if (value := getattr(options, name)) is not None}
    if (source / "scene.json").is_file() or source.name == "scene.json":
        if mesh:
            raise SpecError(
                f"--{next(iter(mesh)).replace('_', '-')} is for meshes; {source} is a scene, whose objects are weighed."
            )
        folder = source if source.is_dir() else source.parent
        code = _scene(folder, out, formats, usd, mesh_paths, options.max_triangles, as_json=options.json)
        notes = [] if options.json else notes
    elif options.json:
        raise SpecError(f"--json tells of scenes; summary.json beside each mesh has the same for {source}.")
    else:
        code = _meshes(source, out, formats, usd, mesh_paths, {**mesh, "max_triangles": options.max_triangles})
    for note in notes:
        console().print(f"note  {note}", markup=False)
    return code


def _levels(given: str | None) -> tuple[int, ...]:
    """The numbers of --usd-levels, each less than the one before."""
    words = [] if given is None else given.split(",")
    try:
        levels = tuple(int(word) for word in words)
    except ValueError:
        levels = (0,)
    if any(number < 1 for number in levels) or list(levels) != sorted(set(levels), reverse=True):
        raise SpecError(
            f"--usd-levels {given}: expected numbers of triangles, each less than the one before: 5000,1000."
        )
    return levels


def _formats(given: list[str] | None) -> tuple[tuple[str, ...], list[str]]:
    """The formats to write, and what to tell about them; all that can be written here where none were given."""
    if given is not None:
        return chosen(given), []
    if has_usd():
        return FORMATS, []
    return tuple(name for name in FORMATS if name != "usd"), [
        "usd was left out, because usd-core is not installed: pip install 'pat3d[usd]'."
    ]


def _scene(
    folder: Path,
    out: Path,
    formats: tuple[str, ...],
    usd: dict[str, Any],
    mesh_paths: str,
    max_triangles: int | None,
    *,
    as_json: bool,
) -> int:
    from pat3d.assets.mesh.simplify import within_budget
    from pat3d.scene.io import load_scene

    with watch(console(stderr=True)) as progress:
        scene, coarse = load_scene(folder), ()
        if max_triangles is not None:
            scene, coarse = within_budget(scene, max_triangles)
        start = time.perf_counter()
        paths = write_formats(scene, formats, out, progress=progress, **usd)
        seconds = time.perf_counter() - start
        if "urdf" in paths and mesh_paths != MESH_PATHS[0]:
            set_mesh_paths(paths["urdf"].parent, mesh_paths)
        record_checksums(out, formats)
        reports = {name: parity(scene, path) for name, path in paths.items() if name not in VIEWS}
    failures = tuple(line for report in reports.values() for line in report.failures)
    if as_json:
        from pat3d.generation.facts import ExportFacts

        files = {name: str(path) for name, path in paths.items()}
        print_facts(ExportFacts(folder=str(out), passed=not failures, failures=list(failures), files=files))
        return verdict(failures)
    target = console()
    if reports:
        target.print(parity_table(reports))
    for name, report in reports.items():
        for line in report.left_out:
            target.print(f"note  {name}: {line}", markup=False)
    for line in coarse:
        target.print(f"note  {line}.", markup=False)
    target.print(f"\n{len(scene.objects)} objects written in {seconds:.2f} s:", markup=False)
    for path in paths.values():
        target.print(f"  {path}", markup=False, soft_wrap=True)
    return verdict(failures)


def _meshes(
    source: Path, out: Path, formats: tuple[str, ...], usd: dict[str, Any], mesh_paths: str, mesh: dict[str, Any]
) -> int:
    from pat3d.generation.asset_export import export_asset, mesh_files
    from pat3d.generation.masses import read_masses

    files = mesh_files(source)
    several = not source.is_file()
    masses = read_masses(Path(mesh.pop("masses")), set(files.values())) if "masses" in mesh else {}
    made: list[ExportedAsset] = []
    refused: list[Pat3dError] = []
    with watch(console(stderr=True)) as progress:
        for number, (path, name) in enumerate(files.items()):
            if several:
                progress(Event(stage="exporting", detail=name, step=number, steps=len(files)))
            own = {**mesh, "mass": masses[name]} if name in masses else mesh
            try:
                folder = out / name if several else out
                made.append(export_asset(path, folder, formats, progress=progress, usd=usd, name=name, **own))
                if "urdf" in formats and mesh_paths != MESH_PATHS[0]:
                    set_mesh_paths(folder / "urdf", mesh_paths)
                    record_checksums(folder)
            except Pat3dError as error:
                if not several:
                    raise
                refused.append(error)
    target = console()
    if made:
        target.print(assets_table(made))
        worst = {
            name: max(made, key=lambda one, key=name: one.parities[key].largest).parities[name]
            for name in formats
            if name not in VIEWS
        }
        target.print()
        target.print(parity_table(worst))
        target.print("\nwritten to:", markup=False)
    for one in made:
        target.print(f"  {one.folder}", markup=False, soft_wrap=True)
    errors = console(stderr=True)
    for error in refused:
        errors.print(f"pat3d: {type(error).__name__}: {error}", markup=False, soft_wrap=True)
    code = verdict(tuple(line for one in made for line in one.failures))
    return max((error.exit_code for error in refused), default=code)


def parity_table(reports: Mapping[str, ParityReport]) -> Any:
    """A row for every parser that read a format back, with its largest errors."""
    from rich.table import Table

    table = Table(box=None, pad_edge=False, header_style="bold")
    for title in ("format", "read back by"):
        table.add_column(title, no_wrap=True)
    for title in ("mass", "centre", "inertia", "friction", "hulls", "position", "rotation"):
        table.add_column(title, justify="right", no_wrap=True)
    table.add_column("")
    for name, report in reports.items():
        for number, reading in enumerate(report.readings):
            errors = [
                "-" if error is None else "0" if error == 0.0 else f"{error:.0e}" for error in reading.worst.values()
            ]
            verdict = "[bold red]FAIL[/]" if reading.failures else "[green]same[/]"
            table.add_row("" if number else name, reading.reader, *errors, verdict)
    table.caption = "Largest errors of any object: relative; position in m, rotation in rad; the limit is 1e-06."
    table.caption_justify = "left"
    return table


def assets_table(made: list[ExportedAsset]) -> Any:
    """A row for every asset."""
    from rich.table import Table

    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("asset", overflow="fold")
    for title in ("cm", "kg", "kg/m^3", "parts", "cavity lost", "repairs", "rest after fall"):
        table.add_column(title, justify="right", no_wrap=True)
    for one in made:
        asset, loss, drop = one.asset, one.cavity_loss, one.drop
        table.add_row(
            asset.noun,
            " x ".join(f"{100 * side:.3g}" for side in asset.size),
            f"{asset.mass_properties.mass:.4g}",
            f"{asset.material.density:.0f}",
            str(len(asset.parts)),
            "-" if loss is None else f"{100 * loss:.1f} %",
            str(len(asset.provenance.get("repairs", ()))),
            "-" if drop is None else f"{drop.seconds:.2f} s" if drop.passed else "[bold red]FAIL[/]",
        )
    return table
