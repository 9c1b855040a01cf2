"""The commands of `pat3d`: a row each, with the module of this package that declares its options and does it.

The module is imported when its command is used, so `pat3d --help` loads none of them.
"""

from __future__ import annotations

from importlib import import_module
from keyword import iskeyword

from pat3d.cli.options import Command

COMMANDS = {
    "plan": ("reading", "say how a sentence is read, and make nothing"),
    "generate": ("making", "make a verified scene from a sentence, or one from every line of a file"),
    "build": ("making", "make a verified scene from a specification with your meshes, sizes and relations"),
    "edit": ("editing", "add, remove, move, turn or replace objects of a scene, which settles again and is verified"),
    "vary": ("editing", "make other scenes that the same relations describe"),
    "import": ("importing", "take a scene or an object of another program (MJCF, URDF, SDF, USD) as a scene folder"),
    "settle": ("settling", "bring a scene whose poses were edited back to rest, and verify it"),
    "optimize": ("mending", "find an initial layout from which a scene settles with its relations where its own fails"),
    "check": ("checking", "verify a scene folder again; exit code 1 when a check fails"),
    "metrics": ("metrics", "the D and R of the paper's Table 1 of scenes, whoever made them: motion, overlaps"),
    "bench": ("metrics", "the paper's Table 1 on your prompts, beside its published rows"),
    "verify": ("verify", "verify a scene file that is not ours: what overlaps, what is not balanced, what moves"),
    "export": ("export", "write a scene, a mesh or a folder of meshes for other programs, and verify it the same"),
    "catalogue": ("catalogue", "what can be made, with pictures"),
    "library": ("library", "folders of other people's objects, indexed, to make scenes from"),
    "suite": ("suites", "scenes with tasks by the thousand, in splits, for training and testing policies"),
    "studio": ("studio", "a scene in the browser: look at it, move and add objects, settle, save, make another"),
    "mcp": ("machines", "let other programs plan, make, edit, check and export scenes, by the Model Context Protocol"),
    "doctor": ("doctor", "what works on this computer, and what would enable more; every part does a real step"),
    "evaluate": ("evaluation", "let a policy do episodes, and report its success rate and failures"),
    "compare": ("evaluation", "compare two policies on the episodes that both did"),
    "leaderboard": ("evaluation", "success rates of several evaluations"),
    "sign": ("evaluation", "sign an evaluation, so that others can see whose it is and that nothing was changed"),
    "replay": ("evaluation", "do recorded episodes again, compare every state, and film them"),
    "train": ("demonstrations", "train a small policy on demonstrations of the scripted one"),
    "demonstrate": ("demonstrations", "write demonstrations of the scripted policy, for robomimic or LeRobot"),
}  # fmt: skip


def find(name: str) -> Command:
    """The command called `name`, which is one of COMMANDS: its namesake in its module (`import_` for import)."""
    return getattr(import_module(f"pat3d.cli.{COMMANDS[name][0]}"), f"{name}_" if iskeyword(name) else name)
