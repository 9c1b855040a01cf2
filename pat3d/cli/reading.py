"""`pat3d plan`: how a sentence is read; and the question which of two readings is meant."""

from __future__ import annotations

import argparse
import sys

from pat3d.cli.options import command, option
from pat3d.plan.describe import describe
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan
from pat3d.plan.telling import tell

PROXIES = option("--allow-proxies", "a plain box for what the catalogue lacks", action="store_true")


@command(
    option("prompt", "what the scene shows, or what a robot is to do, in English", metavar="PROMPT"),
    PROXIES,
    examples="""
    pat3d plan "a laptop, a mouse and two glasses on a desk"
    pat3d plan "put the soup in the basket"                        the scene before, and the task
    """,
)
def plan(options: argparse.Namespace) -> int:
    """`pat3d plan`."""
    made = GrammarPlanner(options.allow_proxies).plan(options.prompt)
    print(f"{tell(made)}\n\n{describe(made)}")
    if made.task is not None:
        print(f"task: {made.task}")
    if made.otherwise:
        print(f"or: {made.otherwise}")
    return 0


class AskingPlanner:
    """Asks on the terminal where a sentence has two readings that are nearly as likely."""

    def __init__(self, allow_proxies: bool = False) -> None:
        self._planner = GrammarPlanner(allow_proxies)

    def plan(self, prompt: str) -> ScenePlan:
        """Plan `prompt` as the user means it.

        Raises:
            PromptError: see GrammarPlanner.
        """
        readings = self._planner.readings(prompt)
        if len(readings) == 1 or not sys.stdin.isatty():
            return self._planner.plan(prompt)
        for number, reading in enumerate(readings, start=1):
            print(f"{number}: {tell(reading)}", file=sys.stderr)
        answer = input(f"Which is meant, 1 to {len(readings)}? [1] ").strip()
        chosen = int(answer) if answer.isdecimal() and 1 <= int(answer) <= len(readings) else 1
        return readings[chosen - 1]


class Decided:
    """A planner that has decided already."""

    def __init__(self, plan: ScenePlan) -> None:
        self._plan = plan

    def plan(self, prompt: str) -> ScenePlan:
        """The plan decided on, whatever `prompt`."""
        return self._plan
