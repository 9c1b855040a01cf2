"""Mutation testing: do the tests notice when a sign, a constant, a comparison or a statement of the code is wrong?

    python benchmarks/mutants.py pat3d/geometry pat3d/layout --count 60 --seed 0

Places are drawn at random from the syntax trees of the given files and folders; each is changed alone, in a temporary
copy of the tree, and the tests that belong to the module run until the first fails (killed) or none does (survived).
Tests belong to a module when they lie in the folder of tests/ that mirrors its own, or in the files given with --tests,
and run some line of it; those that run the changed line come first. The time limit of a mutant is a multiple of what
its tests take on the unchanged code, so a slow machine changes nothing but the time. Exit code 1 where the share that
is killed is below --least.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, field
from itertools import zip_longest
from pathlib import Path
from queue import SimpleQueue

from benchmarks.mutations import Mutation, mutations

ROOT = Path(__file__).resolve().parents[1]
LEFT_OUT = (".git", ".venv", ".hypothesis", ".pytest_cache", ".ruff_cache", "__pycache__", "*.egg-info", "build")
GRACE = 60.0
"""Seconds that every run may take beside the multiple of the unchanged run: starting Python, compiling kernels."""


@dataclass
class Baseline:
    """The tests of a file or folder on the unchanged code."""

    seconds: dict[str, float] = field(default_factory=dict)
    """Time of every test [s]."""
    lines: dict[str, dict[int, list[str]]] = field(default_factory=dict)
    """Tests that run each line of each module; the empty name stands for the import of the module."""

    def tests_of(self, module: str, first: int, last: int) -> list[str]:
        """Tests that run the module, those of lines `first` to `last` before the others, quick ones before slow."""
        lines = self.lines.get(module, {})
        near = {test for line in range(first, last + 1) for test in lines.get(line, ())}
        # What a fixture made is looked at by tests that run no line themselves: all of a file count. What runs at
        # import, or is compiled by Warp and never run by Python, may matter to any test of the folder.
        files = {test.partition("::")[0] for tests in lines.values() for test in tests if test}
        anywhere = not files or "@wp." in (ROOT / module).read_text(encoding="utf-8")
        chosen = [test for test in self.seconds if anywhere or test.partition("::")[0] in files]
        return sorted(chosen, key=lambda test: (test not in near, self.seconds[test]))


@dataclass(frozen=True)
class Verdict:
    """What the tests made of one mutant."""

    mutation: Mutation
    outcome: str
    """killed, timeout (which counts as killed), or survived."""
    by: str
    """The test that failed."""
    seconds: float


class Tree:
    """A temporary copy of the repository in which files may be broken."""

    def __init__(self, root: Path, folder: Path) -> None:
        folder.mkdir()
        self.root = folder / "tree"
        shutil.copytree(root, self.root, symlinks=True, ignore=shutil.ignore_patterns(*LEFT_OUT))
        self._folder = folder

    def pytest(self, paths: Sequence[str], order: dict[str, object], limit: float | None) -> tuple[int | None, str]:
        """Exit code (None: out of time) and output of pytest under the plugin that `order` instructs."""
        orders, scratch = self._folder / "order.json", self._folder / "scratch"
        orders.write_text(json.dumps(order), encoding="utf-8")
        # Caches know contents, not the code that made them: every mutant gets its own.
        shutil.rmtree(scratch, ignore_errors=True)
        scratch.mkdir()
        environment = {
            **os.environ,
            "PYTHONPATH": os.pathsep.join(filter(None, [str(self.root), os.environ.get("PYTHONPATH")])),
            "PYTHONDONTWRITEBYTECODE": "1",
            "PAT3D_CACHE": str(scratch / "cache"),
            # Compiled functions leave no trace of their lines, and compiling them takes longer than running them.
            "NUMBA_DISABLE_JIT": "1",
            "OMP_NUM_THREADS": "1",
            "PAT3D_MUTANT_ORDER": str(orders),
            "TMPDIR": str(scratch),
        }
        command = [sys.executable, "-m", "pytest", "-x", "-q", "--no-header", "-m", "not slow", "--hypothesis-seed=0"]
        command += ["-p", "no:xdist", "-p", "no:cacheprovider", "-p", "benchmarks.mutants_plugin", *paths]
        process = subprocess.Popen(
            command, cwd=self.root, env=environment, text=True, start_new_session=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip
        try:
            output, _ = process.communicate(timeout=limit)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            process.communicate()
            return None, ""
        return process.returncode, output

    def baseline(self, tests: Sequence[str], modules: Sequence[str]) -> Baseline:
        """Run `tests` on the unchanged code and note which of them run which lines of `modules`.

        Raises:
            SystemExit: they fail, so nothing can be said about mutants.
        """
        out = self._folder / "baseline.json"
        code, output = self.pytest(tests, {"watch": list(modules), "out": str(out)}, None)
        if code != 0:
            raise SystemExit(f"{' '.join(tests)}: the tests fail on the unchanged code:\n{output[-3000:]}")
        found = json.loads(out.read_text(encoding="utf-8"))
        lines = {
            module: {int(line): names for line, names in by_line.items()} for module, by_line in found["lines"].items()
        }
        return Baseline(found["seconds"], lines)

    def judge(self, mutation: Mutation, tests: Sequence[str], limit: float) -> Verdict:
        """Run `tests`, in this order, with `mutation` in the code."""
        file = self.root / mutation.path
        original = file.read_bytes()
        start = time.perf_counter()
        try:
            file.write_bytes(mutation.applied(original))
            files = sorted({test.partition("::")[0] for test in tests})
            code, output = self.pytest(files, {"tests": list(tests)}, limit)
        finally:
            file.write_bytes(original)
        seconds = time.perf_counter() - start
        if code is None:
            return Verdict(mutation, "timeout", "", seconds)
        if code == 0:
            return Verdict(mutation, "survived", "", seconds)
        failed = [line for line in output.splitlines() if line.startswith(("FAILED", "ERROR"))]
        return Verdict(mutation, "killed", failed[0].split(" - ")[0].split(" ", 1)[1] if failed else "import", seconds)


def mirrored(module: str) -> str:
    """The folder of tests that mirrors a module: pat3d/assets/mesh/load.py -> tests/assets."""
    parts = Path(module).parts[1:-1] if module.startswith("pat3d/") else Path(module).parts[:-1]
    while parts and not (ROOT / "tests" / Path(*parts)).is_dir():
        parts = parts[:-1]
    return str(Path("tests", *parts))


def drawn(modules: Iterable[str], count: int, seed: int) -> list[Mutation]:
    """`count` mutations, spread evenly over their kinds."""
    rng = random.Random(seed)
    by_kind: dict[str, list[Mutation]] = defaultdict(list)
    for module in modules:
        for mutation in mutations(module, (ROOT / module).read_bytes()):
            by_kind[mutation.kind].append(mutation)
    for found in by_kind.values():
        rng.shuffle(found)
    chosen: list[Mutation] = []
    while len(chosen) < count and any(by_kind.values()):
        chosen += [found.pop() for _, found in sorted(by_kind.items()) if found][: count - len(chosen)]
    return sorted(chosen, key=lambda one: (mirrored(one.path), one.path, one.start))


def test_files(paths: Sequence[str]) -> list[str]:
    """Test files among and under `paths`, relative to the repository."""
    return [file for file in modules_in(paths) if Path(file).name.startswith("test_")]


def merged(baselines: Sequence[Baseline]) -> Baseline:
    """All of them as one."""
    lines: dict[str, dict[int, list[str]]] = defaultdict(lambda: defaultdict(list))
    for one in baselines:
        for module, by_line in one.lines.items():
            for line, tests in by_line.items():
                lines[module][line] += tests
    return Baseline({name: time for one in baselines for name, time in one.seconds.items()}, lines)


def by_turns(chosen: Sequence[Mutation]) -> list[Mutation]:
    """One mutation of each folder of tests after the other."""
    folders: dict[str, list[Mutation]] = defaultdict(list)
    for one in chosen:
        folders[mirrored(one.path)].append(one)
    return [one for turn in zip_longest(*folders.values()) for one in turn if one is not None]


def modules_in(paths: Sequence[str]) -> list[str]:
    """Python files among and under `paths`, relative to the repository."""
    found: list[Path] = []
    for path in paths:
        whole = ROOT / path
        if not whole.exists():
            raise SystemExit(f"{path}: no such file or folder in {ROOT}.")
        found += sorted(whole.rglob("*.py")) if whole.is_dir() else [whole]
    return [str(file.relative_to(ROOT)) for file in dict.fromkeys(found)]


def table(verdicts: Sequence[Verdict]) -> str:
    """Mutants by folder, and every survivor."""
    folders: dict[str, Counter[str]] = defaultdict(Counter)
    for one in verdicts:
        folders[str(Path(one.mutation.path).parent)][one.outcome] += 1
    lines = [f"{'folder':32} {'killed':>7} {'timeout':>8} {'survived':>9}"]
    total: Counter[str] = Counter()
    for folder, counts in sorted(folders.items()):
        total += counts
        lines.append(f"{folder:32} {counts['killed']:7} {counts['timeout']:8} {counts['survived']:9}")
    lines.append(f"{'together':32} {total['killed']:7} {total['timeout']:8} {total['survived']:9}")
    lines += [f"survived: {one.mutation}" for one in verdicts if one.outcome == "survived"]
    return "\n".join(lines)


def main() -> int:
    """Draw, run and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("paths", nargs="+", help="modules and folders to break, relative to the repository")
    parser.add_argument("--count", type=int, default=60, help="mutants (default 60)")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--tests", nargs="+", default=[], help="further test files or folders for all of them")
    parser.add_argument(
        "--ignore", nargs="+", default=[], help="test files left out, where this machine cannot run them"
    )
    parser.add_argument("--jobs", type=int, default=1, help="mutants at a time, each in its own copy (default 1)")
    parser.add_argument("--factor", type=float, default=10.0, help="time limit over the unchanged run (default 10)")
    parser.add_argument("--least", type=float, default=0.0, help="share that must be killed, 0 to 1")
    parser.add_argument("--place", action="append", default=[], help="only FILE:LINE, again after writing a test")
    parser.add_argument("--out", type=Path, help="verdicts as lines of JSON; those that are there are not run again")
    options = parser.parse_args()
    modules = modules_in(options.paths)
    chosen = drawn(modules, 10**9 if options.place else options.count, options.seed)
    if options.place:
        chosen = [one for one in chosen if one.place in options.place]
    known = _known(options.out)
    with tempfile.TemporaryDirectory(prefix="pat3d-mutants-") as scratch, ThreadPoolExecutor(options.jobs) as pool:
        trees: SimpleQueue[Tree] = SimpleQueue()
        for k in range(options.jobs):
            trees.put(Tree(ROOT, Path(scratch, str(k))))

        def baseline(home: str, tests: str) -> Baseline:
            tree = trees.get()
            try:
                return tree.baseline([tests], [module for module in modules if mirrored(module) == home])
            finally:
                trees.put(tree)

        def judge(mutation: Mutation) -> Verdict:
            if str(mutation) in known:
                return Verdict(mutation, *known[str(mutation)])
            unchanged = merged([future.result() for future in baselines[mirrored(mutation.path)]])
            tests = unchanged.tests_of(mutation.path, mutation.line, mutation.last_line)
            limit = GRACE + options.factor * sum(unchanged.seconds[test] for test in tests)
            tree = trees.get()
            try:
                verdict = tree.judge(mutation, tests, limit)
            finally:
                trees.put(tree)
            print(f"{verdict.outcome:8} {verdict.seconds:6.1f} s  {mutation}  {verdict.by}", flush=True)
            if options.out is not None:
                with options.out.open("a", encoding="utf-8") as file:
                    file.write(json.dumps({"name": str(mutation), **asdict(verdict)}) + "\n")
            return verdict

        homes = dict.fromkeys(mirrored(one.path) for one in chosen if str(one) not in known)
        baselines = {
            home: [
                pool.submit(baseline, home, file)
                for file in test_files([home, *options.tests])
                if file not in options.ignore
            ]
            for home in homes
        }
        # Mutants of different folders by turns: those whose baseline is there first need not wait for the others.
        verdicts = list(pool.map(judge, by_turns(chosen)))
    print(table(sorted(verdicts, key=lambda one: (one.mutation.path, one.mutation.start))))
    survived = sum(one.outcome == "survived" for one in verdicts)
    return int(bool(verdicts) and 1.0 - survived / len(verdicts) < options.least)


def _known(out: Path | None) -> dict[str, tuple[str, str, float]]:
    if out is None or not out.is_file():
        return {}
    rows = [json.loads(line) for line in out.read_text(encoding="utf-8").splitlines()]
    return {row["name"]: (row["outcome"], row["by"], row["seconds"]) for row in rows}


if __name__ == "__main__":
    sys.exit(main())
