"""`pat3d library`: folders of other people's objects, indexed once; a gallery of what was found."""

from __future__ import annotations

import argparse

from pat3d.assets.library.index import CPU_LIMIT, Library, add_library, library_names, open_library, remove_library
from pat3d.assets.library.source import LibrarySource
from pat3d.assets.library.store import Entry
from pat3d.cli.console import console, watch
from pat3d.cli.gallery import write_gallery
from pat3d.cli.json_output import JSON, print_facts
from pat3d.cli.options import command, option, with_verbs
from pat3d.errors import AssetError, SpecError


@command(
    option("folder", "folder with the objects, in folders of any depth; nothing is written there", metavar="FOLDER"),
    option("--name", "what sentences and noun keys call it: ycb/power_drill", required=True),
    option("--licence", "of all objects whose own files name none", default="", metavar="TEXT"),
    option("--workers", "processes", type=int, default=None, shown="one a core"),
    option("--cpu-limit", "processor time that one object may take [s]", type=float, default=CPU_LIMIT),
    option("--no-pictures", "write the gallery without pictures", action="store_true"),
    JSON,
    examples="""
    pat3d library add ~/ycb --name ycb
    pat3d library add ~/ycb --name ycb          goes on where it stopped; only what has changed is read again
    """,
    notes="A library.yaml in FOLDER, or in the index, overrides units, up axes, materials, masses, names and licences; "
    "see docs/libraries.md.",
    summary="index a folder of meshes and MJCF, URDF, SDF or USD objects",
)
def add(options: argparse.Namespace) -> int:
    """`pat3d library add`."""
    if options.workers is not None and options.workers < 1:
        raise SpecError(f"--workers is 1 or more, got {options.workers}.")
    with watch(console(stderr=True)) as progress:
        library = add_library(
            options.folder,
            options.name,
            licence=options.licence,
            workers=options.workers,
            cpu_limit=options.cpu_limit,
            progress=progress,
        )
        page = write_gallery(library, pictures=not options.no_pictures, progress=progress)
    if options.json:
        from pat3d.cli.documents import library_facts

        print_facts(library_facts(library))
        return 0 if library.ready else 1
    _told(library)
    console().print(f"gallery: {page}", markup=False, soft_wrap=True)
    return 0 if library.ready else 1


@command(JSON, summary="every library that is indexed")
def list_all(options: argparse.Namespace) -> int:
    """`pat3d library list`."""
    names = library_names()
    if options.json:
        from pat3d.cli.documents import library_facts

        print_facts([library_facts(open_library(name)) for name in names])
        return 0
    if not names:
        console().print("no libraries yet; pat3d library add FOLDER --name NAME", markup=False)
    for name in names:
        library = open_library(name)
        refused = sum(entry.state == "refused" for entry in library.entries)
        more = f", {refused} refused" if refused else ""
        line = f"{name}: {len(library.ready)} objects{more}, of {library.source}"
        console().print(line, markup=False, soft_wrap=True)
    return 0


@command(
    option("name", "a library, or an object of one by its key or by what it is called", metavar="NAME[/OBJECT]"),
    JSON,
    examples="""
    pat3d library show ycb
    pat3d library show ycb/drill
    """,
    summary="what is known of a library, or of one object and why",
)
def show(options: argparse.Namespace) -> int:
    """`pat3d library show`."""
    name, _, said = options.name.partition("/")
    library = open_library(name)
    if options.json:
        from pat3d.cli.documents import library_facts, library_object_facts

        print_facts(library_object_facts(_entry(library, said)) if said else library_facts(library))
        return 0
    if not said:
        for entry in library.entries:
            facts = entry.reason if entry.state != "ready" else _size(entry)
            doubt = f"  ({len(entry.doubts)} doubts)" if entry.doubts else ""
            console().print(f"{name}/{entry.key:32s} {entry.state:8s} {facts}{doubt}", markup=False, soft_wrap=True)
        _told(library)
        return 0
    _show_entry(library, _entry(library, said))
    return 0


@command(
    option("words", "what is looked for: a name, or where an embeddings server is set up, a description"),
    option("--libraries", "libraries to look in", nargs="+", default=None, shown="all", metavar="NAME"),
    JSON,
    examples="""
    pat3d library search "power drill"
    pat3d library search "to cut paper with" --libraries ycb lab
    """,
    notes="Names alone decide unless PAT3D_EMBEDDINGS names a model of a server that speaks OpenAI's /embeddings "
    "(PAT3D_EMBEDDINGS_URL, PAT3D_EMBEDDINGS_KEY). Vectors are kept in the index.",
    summary="what is called so, or is nearest in meaning",
)
def search(options: argparse.Namespace) -> int:
    """`pat3d library search`."""
    from pat3d.assets.library import meaning

    settings = meaning.embedding_settings()
    found = meaning.search(options.words, options.libraries or library_names(), settings=settings)
    if options.json:
        from pat3d.cli.documents import FoundFacts

        print_facts([FoundFacts(noun=one.noun, name=one.name, score=float(one.score)) for one in found])
        return 0 if found else 1
    for one in found:
        console().print(f"{one.noun:40s} {one.score:.2f}  {one.name}", markup=False, soft_wrap=True)
    if not found:
        more = "" if settings else f"; by names alone, since {meaning.MODEL} names no embeddings model"
        console().print(f'nothing is called "{options.words}"{more}.', markup=False, soft_wrap=True)
    return 0 if found else 1


@command(
    option("name", "a library", metavar="NAME"),
    JSON,
    summary="forget a library: its index is removed, its objects stay",
)
def remove(options: argparse.Namespace) -> int:
    """`pat3d library remove`."""
    if options.json:
        from pat3d.cli.documents import library_facts

        facts = library_facts(open_library(options.name))
        remove_library(options.name)
        print_facts(facts)
        return 0
    source = remove_library(options.name)
    console().print(f"removed the index of {options.name}; {source} is as it was.", markup=False, soft_wrap=True)
    return 0


library = with_verbs(
    add=add,
    list=list_all,
    show=show,
    search=search,
    remove=remove,
    examples="""
    pat3d library add ~/ycb --name ycb
    pat3d library list
    pat3d library show ycb/drill
    pat3d library search "power drill"
    pat3d generate "the YCB drill beside a sugar box on a tray" --libraries ycb --out scenes/drill
    pat3d library remove ycb
    """,
)


def _entry(library: Library, said: str) -> Entry:
    """The object of `library` whose key or name is `said`."""
    for entry in library.entries:
        if said == entry.key or said.replace("_", " ") == entry.name:
            return entry
    found = LibrarySource(library.name).find(said.replace("_", " "))
    if found and found[0].score >= 0.6:
        key = found[0].noun.split("/", 1)[1]
        return next(entry for entry in library.entries if entry.key == key)
    near = ", ".join(one.noun for one in found[:3]) or f"pat3d library show {library.name} lists what is there"
    raise AssetError(f'library "{library.name}" has no "{said}". Nearest: {near}.')


def _show_entry(library: Library, entry: Entry) -> None:
    target, facts = console(), entry.facts
    target.print(f"{library.name}/{entry.key}", style="bold", markup=False)
    rows = [("called", ", ".join((entry.name, *entry.synonyms))), ("file", str(library.source / entry.path))]
    rows += [("is like", entry.like)] if entry.like else []
    if entry.state != "ready":
        rows.append((entry.state, entry.reason))
    else:
        rows += [
            ("size", _size(entry) + " (width, depth, height)"),
            ("unit", f"{facts['unit']['value']}: {facts['unit']['reason']}"),
            ("up", f"{facts['up']['value']}: {facts['up']['reason']}"),
            ("mass", f"{facts['mass']:.3g} kg, from {facts['mass_from']}"),
            ("friction", f"{facts['friction']:g}"),
            ("rests", _rests(entry)),
            ("convex parts", f"{facts['parts']}"),
            ("room for things", _places(entry)),
            ("licence", facts["licence"]),
            ("indexed in", f"{entry.seconds:.1f} s, {entry.processor:.1f} s of the processor"),
        ]
        rows += [("note", note) for note in facts["notes"][:6]]
    rows += [("doubt", doubt) for doubt in entry.doubts]
    for label, text in rows:
        target.print(f"  {label:16s} {text}", markup=False, soft_wrap=True)


def _told(library: Library) -> None:
    refused = [entry for entry in library.entries if entry.state == "refused"]
    doubtful = sum(bool(entry.doubts) for entry in library.ready)
    for entry in refused:
        console().print(f"refused: {entry.path}: {entry.reason}", markup=False, soft_wrap=True)
    console().print(
        f"{library.name}: {len(library.ready)} objects ready, {doubtful} of them with doubts, {len(refused)} refused",
        markup=False,
    )


def _size(entry: Entry) -> str:
    return " x ".join(f"{100 * side:.1f}" for side in entry.facts["size"]) + " cm"


def _rests(entry: Entry) -> str:
    shown = [f"{rest['tilt']:.0f} degrees from upright ({100 * rest['probability']:.0f} %)" for rest in
             entry.facts["resting"][:3]]  # fmt: skip
    return ", ".join(shown) or "-"


def _places(entry: Entry) -> str:
    return ", ".join(
        f"{place['kind']} ({200 * place['half_size'][0]:.0f} x {200 * place['half_size'][1]:.0f} cm)"
        for place in entry.facts["places"]
    )
