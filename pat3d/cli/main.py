"""The `pat3d` command."""

from __future__ import annotations

import argparse
import signal
import sys
from collections.abc import Sequence
from typing import Any

import pat3d
from pat3d.errors import Pat3dError

EXAMPLES = {
    "generate": """
  pat3d generate "a red mug on a wooden table" --out scenes/mug
  pat3d generate "a bowl of three apples next to a stack of four books" --out scenes/desk --seed 3
""",
    "plan": """
  pat3d plan "a laptop, a mouse and two glasses on a desk"
  pat3d plan "put the soup in the basket"                        the scene before, and the task
""",
    "build": """
  pat3d build scene.yaml --out scenes/mine
  pat3d build --schema > scene.schema.json
""",
    "optimize": """
  pat3d optimize scenes/tower                    mend the scene in its folder
  pat3d optimize scenes/tower --out scenes/mend  write another folder, leave this one as it is
  pat3d optimize scenes/tower --starts 1         gradient steps from the scene's own layout only
""",
    "check": """
  pat3d check scenes/mug
  pat3d check scenes/mug --engines mujoco,newton,pybullet,drake,physx
""",
    "export": """
  pat3d export scenes/desk --formats mjcf,usd,urdf --out exports/desk
  pat3d export scenes/desk --formats usd --usda --usdz --out exports/desk
  pat3d export mug.glb --mass 0.3 --out assets/mug                   one mesh: repaired, decomposed, dropped
  pat3d export scans/ --material ceramic --units mm --out assets     every mesh of a folder
""",
    "catalogue": """
  pat3d catalogue                        list everything by family
  pat3d catalogue mug                    one object, with a picture in mug.png
  pat3d catalogue --sheet catalogue.png  pictures of everything
""",
    "suite": """
  pat3d suite generate suites/tabletop --tasks pick,place,stack,sort,unload --scenes 1000 --seed 0 --workers auto
  pat3d suite check suites/tabletop
  pat3d suite show suites/tabletop
""",
    "doctor": """
  pat3d doctor
""",
    "evaluate": """
  pat3d evaluate --policy scripted --episodes 50 --out eval/scripted
  pat3d evaluate --scene scenes/desk --task "pick:red mug" --policy ws://127.0.0.1:8000 --out eval/server
  pat3d evaluate --suite suites/tabletop --split test --policy my_package.my_policy:make --workers auto --out eval/mine
""",
    "compare": """
  pat3d compare eval/a eval/b
""",
    "leaderboard": """
  pat3d leaderboard eval/*
""",
    "replay": """
  pat3d replay eval/a --episode 17 --video out.mp4
  pat3d replay eval/a                    do every episode again and compare every state
""",
    "train": """
  pat3d train --episodes 100 --perturb pose=0.04 --out cloned.pt
""",
    "demonstrate": """
  pat3d demonstrate --episodes 100 --perturb pose=0.04 --out mug.hdf5                  for robomimic
  pat3d demonstrate --suite suites/tabletop --split train --obs rgb --out tabletop     a LeRobotDataset, with films
""",
}


def parser() -> argparse.ArgumentParser:
    """The command line."""
    main_parser = argparse.ArgumentParser(
        prog="pat3d",
        description="From a sentence to a manipulation scene that does not move when a simulator loads it.",
    )
    main_parser.add_argument("--version", action="version", version=f"pat3d {pat3d.__version__}")
    commands = main_parser.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def command(name: str, summary: str) -> argparse.ArgumentParser:
        return commands.add_parser(
            name,
            help=summary,
            description=summary[0].upper() + summary[1:] + ".",
            epilog="examples:" + EXAMPLES[name],
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )

    making = command("generate", "make a verified scene from a sentence")
    making.add_argument("prompt", metavar="PROMPT", help="what the scene shows, in English")
    making.add_argument("--allow-proxies", action="store_true", help="a plain box for what the catalogue lacks")
    making.add_argument("--ask", action="store_true", help="on a terminal, ask where the sentence has two readings")
    _add_making(making, seed=0, friction=0.2)

    reading = command("plan", "say how a sentence is read, and make nothing")
    reading.add_argument("prompt", metavar="PROMPT", help="what the scene shows, or what a robot is to do, in English")
    reading.add_argument("--allow-proxies", action="store_true", help="a plain box for what the catalogue lacks")

    building = command("build", "make a verified scene from a specification with your meshes, sizes and relations")
    building.add_argument("spec", metavar="SCENE.YAML", nargs="?", help="the specification")
    building.add_argument("--schema", action="store_true", help="print the JSON schema of specifications and stop")
    _add_making(building, seed=None, friction=None)

    mending = command(
        "optimize", "find an initial layout that keeps the scene's relations while it settles, where its own does not"
    )
    mending.add_argument("folder", metavar="SCENE", help="scene folder that generate or build wrote")
    mending.add_argument("--out", metavar="FOLDER", help="scene folder to write (default: SCENE is replaced)")
    mending.add_argument("--epochs", type=int, default=50, help="gradient steps at most; 0 for none (50)")
    mending.add_argument(
        "--starts", type=int, default=6, help="layouts tried before gradients, the scene's own among them (6)"
    )
    mending.add_argument("--seed", type=int, help="of the layouts tried (the scene's)")
    mending.add_argument("--device", choices=("cpu", "cuda"), default="cpu", help="where to simulate (cpu)")

    checking = command("check", "verify a scene folder again; exit code 1 when a check fails")
    checking.add_argument("folder", metavar="FOLDER", help="what generate or build wrote")
    checking.add_argument(
        "--engines",
        nargs="+",
        metavar="ENGINE",
        help="measure the drift in these engines instead: mujoco, mujoco-oldest, mujoco-newest, "
        "newton-mujoco, newton-xpbd, newton (both), pybullet, drake, physx, or all",
    )
    checking.add_argument("--seconds", type=float, default=5.0, help="simulated time with --engines (5)")

    exporting = command(
        "export", "write a scene, a mesh or a folder of meshes for other programs, and verify it the same"
    )
    exporting.add_argument("source", metavar="SOURCE", help="a scene folder, a mesh file, or a folder of meshes")
    exporting.add_argument("--out", metavar="FOLDER", required=True, help="where to write; each format has its folder")
    exporting.add_argument(
        "--formats", nargs="+", metavar="FORMAT", help="mjcf, usd, urdf, sdf, with commas or spaces between (all)"
    )
    exporting.add_argument("--usda", action="store_true", help="USD as text, scene.usda")
    exporting.add_argument("--usdz", action="store_true", help="USD also in one file, scene.usdz")
    meshes = exporting.add_argument_group("meshes only")
    weight = meshes.add_mutually_exclusive_group()
    weight.add_argument("--mass", type=float, metavar="KG", help="mass of the object")
    weight.add_argument("--density", type=float, metavar="KG/M3", help="density of the closed surface")
    meshes.add_argument("--material", metavar="NAME", help="for density and friction (plastic)")
    meshes.add_argument("--friction", type=float, metavar="MU", help="friction coefficient (the material's)")
    meshes.add_argument("--units", metavar="UNIT", help="of the file: m, cm, mm, in (m)")
    meshes.add_argument("--scale", type=float, help="factor on the file's coordinates")
    meshes.add_argument("--size", type=float, metavar="M", help="longest side, instead of units and scale")
    meshes.add_argument("--up", metavar="AXIS", help="the file's axis that points up: z, -y, ... (y for glTF, else z)")
    meshes.add_argument("--parts", metavar="HOW", help="convex parts by coacd, hull or box (coacd)")
    meshes.add_argument("--thickness", type=float, metavar="M", help="of the walls of an open shell")

    listing = command("catalogue", "what can be made, with pictures")
    listing.add_argument("name", metavar="NAME", nargs="?", help="noun or synonym")
    listing.add_argument("--sheet", metavar="PNG", help="write pictures of everything")
    listing.add_argument("--out", metavar="PNG", help="picture of NAME (default: ./NAME.png)")
    listing.add_argument("--seed", type=int, default=0, help="variation of what is drawn")

    from pat3d.cli.suites import add_arguments

    suites = command("suite", "scenes with tasks by the thousand, in splits, for training and testing policies")
    add_arguments(suites, argparse.RawDescriptionHelpFormatter)

    command("doctor", "what works on this computer, and what would enable more")
    from pat3d.cli.evaluation import add_commands

    add_commands(command)
    return main_parser


def _add_making(to: argparse.ArgumentParser, *, seed: int | None, friction: float | None) -> None:
    shown = {"seed": "0", "friction": "0.2"} if seed is not None else dict.fromkeys(("seed", "friction"), "the file's")
    to.add_argument("--out", metavar="FOLDER", help="scene folder to write; an earlier one is replaced at the end")
    to.add_argument("--seed", type=int, default=seed, help=f"the same seed gives the same scene ({shown['seed']})")
    to.add_argument(
        "--friction", type=float, default=friction, help=f"friction coefficient while settling ({shown['friction']})"
    )
    to.add_argument("--device", choices=("cpu", "cuda"), default="cpu", help="where to simulate (cpu)")
    to.add_argument(
        "--formats",
        nargs="+",
        default=["mjcf"],
        metavar="FORMAT",
        help="mjcf, usd, urdf, sdf, with commas or spaces between (mjcf)",
    )
    to.add_argument(
        "--resume",
        action="store_true",
        help="keep finished stages in FOLDER.partial, and go on from those of an earlier run",
    )


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line `argv`; returns the exit code."""
    options = parser().parse_args(argv)
    previous = signal.getsignal(signal.SIGTERM)
    try:
        # Ended by another program, a run tidies up as after Ctrl-C.
        signal.signal(signal.SIGTERM, _interrupt)
    except ValueError:
        previous = None
    try:
        return _run(options)
    except Pat3dError as error:
        print(f"pat3d: {type(error).__name__}: {error}", file=sys.stderr)
        return error.exit_code
    except KeyboardInterrupt:
        print("pat3d: interrupted", file=sys.stderr)
        return 130
    except BrokenPipeError:
        sys.stderr.close()
        return 141
    finally:
        if previous is not None:
            signal.signal(signal.SIGTERM, previous)


def _interrupt(*_: Any) -> None:
    raise KeyboardInterrupt


def _run(options: argparse.Namespace) -> int:
    if options.command == "plan":
        # Reading a sentence needs nothing of what makes a scene.
        from pat3d.cli.reading import plan

        return plan(options)
    from pat3d.cli import commands

    return getattr(commands, options.command)(options)
