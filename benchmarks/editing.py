r"""How long a scene takes to come to rest again after one edit, and to be verified.

    pat3d generate "a stack of three books, a vase, a red mug, a bowl with two apples and a laptop on a desk" \
        --out scenes/ten
    python benchmarks/editing.py scenes/ten [--repeats 3]

Ten objects. Every edit starts from the scene in the folder. "edit" is reading the words and laying out, "settle" the
simulator, "verify" the whole verification with 5 s of MuJoCo. Wall time, and processor time of all threads, which a
busy machine does not change much. The simulator's kernels are loaded before the clock starts, as in a program that
stays open. "moved" is the farthest that anything went that the edit did not touch and that rests on nothing touched.
"""

from __future__ import annotations

import argparse
import statistics
import time

from pat3d.errors import Pat3dError
from pat3d.generation.editing.draft import carried
from pat3d.generation.editing.editable import EditableScene, load
from pat3d.generation.editing.resettling import settled
from pat3d.generation.editing.said import applied
from pat3d.sim.compilation import prepare

EDITS = (
    ("remove", "bottom book"),
    ("remove", "top book"),
    ("remove", "the bowl"),
    ("remove", "laptop"),
    ("add", "a coffee mug on the stack of books"),
    ("add", "a green apple to the left of the laptop"),
    ("add", "a pen in the red mug"),
    ("move", "red mug: onto the books"),
    ("move", "vase: 2 cm back"),
    ("move", "bowl: 3 cm back"),
    ("turn", "laptop: 10 degrees"),
    ("replace", "vase: a plant pot"),
    ("scale", "vase: 10 % smaller"),
    ("set", "vase: mass=2"),
    ("fix", "desk"),
)
GOALS = (2.0, 4.0)
"""Seconds on 2 cores: to rest, and verified."""


class Stopwatch:
    """Wall and processor time since it was started [s]."""

    def __init__(self) -> None:
        self._wall, self._cpu = time.perf_counter(), time.process_time()

    def read(self) -> tuple[float, float]:
        """Both."""
        return time.perf_counter() - self._wall, time.process_time() - self._cpu


def timed(scene: EditableScene, edit: tuple[str, str]) -> dict[str, tuple[float, float]]:
    """Wall and processor time of the stages of one edit."""
    watch = Stopwatch()
    edited = applied(scene, [edit])
    laid = watch.read()
    watch = Stopwatch()
    settled(edited.draft, edited.before)
    rest = watch.read()
    watch = Stopwatch()
    done = edited.settle()
    both = watch.read()
    verify = (both[0] - rest[0], both[1] - rest[1])
    still = untouched(edited, done)
    return {"edit": laid, "settle": rest, "verify": verify, "moved": (still, still)}


def untouched(edited: EditableScene, done: EditableScene) -> float:
    """Farthest motion of what the edit did not touch [mm]."""
    touched = set(carried(edited.draft.scene, edited.draft.touched)) if edited.draft.touched else set()
    changes = done.changes
    return max((one.mm for name, one in changes.moved.items() if name not in touched), default=0.0) if changes else 0.0


def main() -> None:
    """Time every edit and print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", help="scene folder")
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    prepare("cpu", lambda event: None)
    scene = load(options.scene)
    applied(scene, [EDITS[0]]).settle()
    print(f"{len(scene.scene.objects)} objects; median of {options.repeats}; wall / processor seconds")
    print(f"{'edit':52} {'edit':>11} {'settle':>11} {'verify':>11} {'moved mm':>9}")
    rows = []
    for edit in EDITS:
        try:
            runs = [timed(scene, edit) for _ in range(options.repeats)]
        except Pat3dError as error:
            print(f"{' '.join(edit):52} refused: {error}")
            continue
        row = {key: tuple(statistics.median(run[key][at] for run in runs) for at in range(2)) for key in runs[0]}
        rows.append(row)
        cells = " ".join(f"{row[key][0]:5.2f}/{row[key][1]:5.2f}" for key in ("edit", "settle", "verify"))
        print(f"{' '.join(edit):52} {cells} {row['moved'][0]:9.1g}")
    for name, keys, goal in (
        ("to rest", ("edit", "settle"), GOALS[0]),
        ("verified", ("edit", "settle", "verify"), GOALS[1]),
    ):
        wall, cpu = (statistics.median(sum(row[key][at] for key in keys) for row in rows) for at in range(2))
        print(f"median {name}: {wall:.2f} s wall, {cpu:.2f} s processor (goal {goal:g} s)")


if __name__ == "__main__":
    main()
