"""What works on this computer, and what would enable more."""

from __future__ import annotations

import argparse
import os
import platform
import re
import sys
import tempfile
from importlib.util import find_spec
from pathlib import Path
from typing import Literal

from pat3d.cli.console import console, watch
from pat3d.cli.extras import DEVELOPMENT, ENABLES, requirements
from pat3d.cli.json_output import JSON, print_facts
from pat3d.cli.options import command
from pat3d.errors import ModelError
from pat3d.progress import Event, Progress
from pat3d.scene.versions import version_of

State = Literal["ok", "no", "FAULT"]
"""Works; is not here, and need not be; is wrong."""


class Table:
    """What was found, a row each."""

    def __init__(self) -> None:
        from rich.table import Table as Rows

        self.rows = Rows(box=None, pad_edge=False, show_header=False)
        self.rows.add_column(width=6)
        self.rows.add_column()
        self.rows.add_column(overflow="fold")
        self.faults = 0
        self.parts: list[tuple[State, str, str]] = []

    def add(self, state: State, what: str, text: str) -> None:
        """Add a row; a fault makes the exit code 1."""
        self.faults += state == "FAULT"
        self.parts.append((state, what, text))
        colour = {"ok": "green", "no": "yellow", "FAULT": "red"}[state]
        self.rows.add_row(f"[{colour}]{state}[/]", what, text.replace("[", r"\["))


@command(
    JSON,
    examples="""
    pat3d doctor
    """,
)
def doctor(options: argparse.Namespace) -> int:
    """`pat3d doctor`: 1 where something that is needed is missing, or something that is installed does not work."""
    table = Table()
    with watch(console(stderr=True)) as progress:
        _computer(table)
        _packages(table)
        _warp(table)
        _parts(table, progress)
        _menagerie(table)
        _renderers(table)
        _engines(table)
        _model(table)
        _photographs(table)
        _embeddings(table)
        _metrics(table)
    from pat3d.scene.cache import cache_root

    table.add("ok", "mesh cache", _folder(cache_root()))
    if options.json:
        from pat3d.cli.documents import PartFacts

        print_facts([PartFacts(state=state, part=what, found=text) for state, what, text in table.parts])
    else:
        console().print(table.rows)
    return 1 if table.faults else 0


def _computer(table: Table) -> None:
    table.add("ok", "Python", f"{platform.python_version()}, {sys.executable}")
    table.add("ok", "computer", f"{platform.system()} {platform.machine()}, {_cores()} cores, {_memory()}")


def _packages(table: Table) -> None:
    """Every package that the metadata names: the needed ones, then those of the extras."""
    asked = requirements()
    if not asked:
        table.add("no", "packages", "pat3d itself is not installed, so nothing says what it needs: pip install -e .")
    seen = set()
    for one in sorted(asked, key=lambda one: one.extra != ""):
        if one.extra == DEVELOPMENT or one.name in seen or one.name == "pat3d":
            continue
        seen.add(one.name)
        found = version_of(one.name)
        least = f"needs {one.least} or newer" if one.least else "any version"
        what = f": {ENABLES[one.extra]}" if one.extra in ENABLES else ""
        if found is None and one.extra:
            advice = f"pip install 'pat3d[{one.extra}]'"
            table.add("no", one.name, f"not installed; would enable{what.removeprefix(':')}: {advice}")
        elif found is None or _number(found) < _number(one.least):
            advice = f"pip install 'pat3d[{one.extra}]' again" if one.extra else "pip install pat3d again"
            table.add("FAULT", one.name, f"{found or 'missing'} ({least}): {advice}")
        else:
            table.add("ok", one.name, f"{found} ({least}){what}")


def _parts(table: Table, progress: Progress) -> None:
    """One real step of every part that can be here."""
    from pat3d.cli.parts import PARTS
    from pat3d.sim.startup import quiet_warp

    for number, part in enumerate(PARTS):
        progress(Event(stage="trying", detail=part.name, step=number, steps=len(PARTS)))
        if part.missing:
            table.add("no", part.name, f"not tried for want of {', '.join(part.missing)}")
            continue
        if part.gpu and not quiet_warp().is_cuda_available():
            table.add("no", part.name, "not tried for want of a GPU")
            continue
        with tempfile.TemporaryDirectory(prefix="pat3d-doctor-") as scratch:
            try:
                table.add("ok", part.name, part.step(Path(scratch)))
            except Exception as error:
                # Whatever a broken installation raises is the finding.
                table.add("FAULT", part.name, f"{type(error).__name__}: {error}")


def _warp(table: Table) -> None:
    """Report Warp's devices and its compiled kernels."""
    try:
        from pat3d.sim.compilation import cache_folder, is_warm
        from pat3d.sim.startup import quiet_warp

        devices = [f"{device.alias} ({device.name})" for device in quiet_warp().get_devices()]
        table.add("ok", "simulator", "runs on " + ", ".join(devices))
        if not any(name.startswith("cuda") for name in devices):
            table.add("no", "GPU", "none that CUDA knows; an NVIDIA driver would enable --device cuda")
        warm = "compiled" if is_warm() else "not compiled before this; that takes up to a minute"
        table.add("ok", "kernels", f"{warm}: {_folder(cache_folder())}")
    except Exception as error:
        # Whatever a broken installation raises is the finding.
        table.add("FAULT", "simulator", f"Warp does not start: {type(error).__name__}: {error}")


def _menagerie(table: Table) -> None:
    """Report which robots' models are here; the others are downloaded when they are first asked for."""
    from pat3d.envs.robots.menagerie import ARMS, arms_here

    if find_spec("mujoco_menagerie") is None:
        table.add("no", "robots", "MuJoCo Menagerie would bring them: pip install 'pat3d[robots]'")
        return
    here = arms_here()
    rest = [name for name in ARMS if name not in here]
    later = f"; downloaded on first use: {', '.join(rest)}" if rest else ""
    table.add("ok", "robots", f"here: {', '.join(here) or 'none'}{later}")


def _engines(table: Table) -> None:
    """Report which engines `pat3d check --engines` can run."""
    from pat3d.check.engines.environments import NAMES, engines_root, how_to_get, is_made

    for name in NAMES:
        if is_made(name):
            table.add("ok", name, f"engine for pat3d check --engines, in {engines_root() / name}")
        else:
            table.add("no", name, f"would let pat3d check --engines run scenes there: {how_to_get(name)}")


def _model(table: Table) -> None:
    """Report which language model is set up; nobody is asked."""
    from pat3d.plan.llm.settings import KEYS, load_settings

    try:
        settings = load_settings()
    except ModelError as error:
        table.add("no", "language model", f"for --planner llm and --critic: {error}")
        return
    key = "a key from the environment" if settings.key else f"no key ({' or '.join(KEYS)})"
    looks = f", pictures by {settings.vision}" if settings.vision else ""
    table.add("ok", "language model", f"{settings.name} on {settings.server}{looks}, with {key}")


def _photographs(table: Table) -> None:
    """Report what `pat3d generate --image` can do without files; nobody is asked, and no weights are loaded."""
    from pat3d.vision.models import EXAMPLES, INSTALL, VARIABLES, can_load, vision_models
    from pat3d.vision.painting import MODEL, URL, image_settings

    try:
        named, painter = vision_models(), image_settings()
    except ModelError as error:
        table.add("FAULT", "photographs", str(error))
        return
    if not can_load():
        table.add("no", "photographs", f"depth and masks come from files; {INSTALL} lets models find them")
    else:
        for key, variable in VARIABLES.items():
            name = getattr(named, key)
            advice = f"{variable} names a model, such as {EXAMPLES[key]}"
            table.add("no" if name is None else "ok", f"photographs, {key}", advice if name is None else str(name))
    if painter is None:
        table.add("no", "photographs, painting", f"for --paint: {MODEL} names a model, {URL} its server")
    else:
        table.add("ok", "photographs, painting", f"{painter.name} on {painter.server}")


def _embeddings(table: Table) -> None:
    """Report which server finds objects of libraries by meaning; nobody is asked."""
    from pat3d.assets.library.meaning import MODEL, URL, embedding_settings

    try:
        settings = embedding_settings()
    except ModelError as error:
        table.add("no", "search by meaning", str(error))
        return
    if settings is None:
        table.add("no", "search by meaning", f"for pat3d library search: {MODEL} names a model, {URL} its server")
        return
    table.add("ok", "search by meaning", f"{settings.model} on {settings.server}")


def _metrics(table: Table) -> None:
    """Report which columns of the paper's table `pat3d metrics` can fill."""
    from pat3d.check.metrics.remeshing import can_remesh

    if can_remesh():
        table.add("ok", "metrics", "D, R on delivered meshes, R on meshes of fTetWild")
    else:
        table.add(
            "no", "metrics", "D, R on delivered meshes; pip install 'pat3d[metrics]' adds R on meshes of fTetWild"
        )


def _renderers(table: Table) -> None:
    """Report what draws the pictures of environments, and what else could."""
    from pat3d.view.gl import KINDS, gl_renderer, is_software

    found = {kind: gl_renderer(kind) for kind in KINDS}
    used = next((kind for kind in KINDS if found[kind]), None)
    for kind, name in found.items():
        title = {"egl": "EGL", "osmesa": "OSMesa"}[kind]
        if name is None:
            table.add(
                "no", title, f"MuJoCo's own renderer does not work through it; lib{kind}{_MAJOR[kind]} would enable it"
            )
        else:
            where = "on the CPU, " if is_software(name) else ""
            does = "draws the pictures of environments" if kind == used else "works too"
            table.add("ok", title, f"MuJoCo's own renderer, {where}{does} ({name})")
    if used is None:
        table.add("ok", "ray tracer", "draws the pictures of environments, on the CPU")


_MAJOR = {"egl": "1", "osmesa": "6"}
"""Debian's versions of the libraries."""


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _memory() -> str:
    try:
        size = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError, OSError):
        return "memory unknown"
    return f"{size / 2**30:.1f} GiB of memory"


def _folder(path: Path) -> str:
    """A folder and how much is in it."""
    try:
        size = sum(file.stat().st_size for file in path.rglob("*") if file.is_file())
    except OSError:
        size = 0
    return f"{path} ({size / 1e6:.0f} MB)" if path.is_dir() else f"{path} (made when needed)"


def _number(version: str) -> tuple[int, ...]:
    """The numbers of a version: (3, 9, 0) for "3.9.0rc1"."""
    return tuple(int(part) for part in re.findall(r"\d+", re.split(r"[a-z+]", version)[0]))
