"""Other people's validators over USD exports: OpenUSD's own, NVIDIA's, and the rigid-body rules of SimReady.

    python benchmarks/usd_validators.py exports/desk/usd exports/bowl/usd exports/desk/simready [--scenes]

Theirs run in environments of their own (`--environments`), made on the first run: their pins contradict ours, and
SimReady's rules, once installed, join NVIDIA's and ask every scene to be a robot. A scene is held to OpenUSD's,
NVIDIA's and our rules, every asset of it to SimReady's too; those of a simready export to the whole profile. Exits with
1 if any complains.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

PACKAGES = {
    "nvidia": ("usd-validation-nvidia==1.22.0", "usd-core==26.11", "numpy==2.4.6"),
    "simready": ("simready-validate==2026.8.0", "simready-foundation-tier-core==2026.8.0", "numpy==2.4.6"),
}

PROFILE = ("Robotics-Prop", "4.0.0")

FEATURES = {
    "FET_001_STANDARD": "minimal",
    "FET_003_STANDARD": "rigid bodies",
    "FET_003_PHYSX": "rigid bodies, PhysX",
    "FET_003_NEWTON": "rigid bodies, Newton",
    "FET_003_MUJOCO": "rigid bodies, MuJoCo",
    "FET_006_STANDARD": "UsdPreviewSurface",
    "FET_011_STANDARD": "semantic labels",
    "FET_011_RTX": "labels of materials",
    "FET_031_STANDARD": "self-contained",
}
"""What an object in a scene can be held to; the rest is about robots, packages and catalogues."""

TIMEOUT = 600.0
"""[s], of one validator on one file."""


def environment(folder: Path, name: str) -> Path:
    """The programs of environment `name` under `folder`, installed if need be."""
    programs = folder / name / "bin"
    if not (folder / name / ".made").exists():
        subprocess.run([sys.executable, "-m", "venv", str(folder / name)], check=True)
        pip = [str(programs / "python"), "-m", "pip", "install", "--quiet", *PACKAGES[name]]
        subprocess.run(pip, check=True)
        (folder / name / ".made").touch()
    return programs


def openusd(path: Path) -> list[str]:
    """Errors and warnings of every validator that comes with usd-core."""
    from pxr import Usd, UsdValidation

    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    return [error.GetErrorAsString() for error in context.Validate(Usd.Stage.Open(str(path)))]


def ours(path: Path) -> list[str]:
    """Findings of our lint."""
    from pat3d.check.usd_lint.rules import lint_usd

    return [str(finding) for finding in lint_usd(path)]


def nvidia(path: Path, programs: Path) -> list[str]:
    """Issues of nvidia_usd_validate with its default rules."""
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "report.json"
        done = _run([str(programs / "nvidia_usd_validate"), "--json-output", str(output), str(path)])
        if not output.exists():
            return [f"nvidia_usd_validate ended with {done.returncode}: {done.stderr[-300:]}"]
        report = json.loads(output.read_text(encoding="utf-8"))
    return [] if report["status"] == "PASS" else [json.dumps(rule)[:300] for rule in report["rules"]]


def simready(path: Path, programs: Path, *, whole: bool = False) -> list[str]:
    """Requirements of `FEATURES` that an asset fails, or where it fails the `whole` profile."""
    profile, version = PROFILE
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "report.json"
        command = [str(programs / "simready-validate"), "--profile", profile, "--version", version]
        done = _run([*command, "--output", str(output), str(path)])
        if not output.exists():
            return [f"simready-validate ended with {done.returncode}: {done.stderr[-300:]}"]
        if whole:
            return [] if f"[PASSED] {profile} v{version}" in done.stdout else [done.stdout[-600:]]
        (report,) = json.loads(output.read_text(encoding="utf-8")).values()
    features = report["features_summary"]
    absent = [f"{name} was not checked" for name in FEATURES if name not in features]
    failed = [
        f"{name} ({words}): {features[name]['requirement_messages']}"
        for name, words in FEATURES.items()
        if name in features and not features[name]["passed"]
    ]
    return absent + failed


def _run(command: list[str]) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT, check=False)


def main() -> int:
    """Validate every scene file and every asset under the folders given."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folders", type=Path, nargs="+", help="folders written by write_usd")
    where = Path("build/usd-validators")
    parser.add_argument("--environments", type=Path, default=where, help="where the validators live")
    parser.add_argument("--scenes", action="store_true", help="scene files alone; SimReady has no rules for them")
    arguments = parser.parse_args()
    needed = ("nvidia",) if arguments.scenes else tuple(PACKAGES)
    theirs = {name: environment(arguments.environments.resolve(), name) for name in needed}
    bad = 0
    print(f"{'file':48s} {'OpenUSD':>8s} {'ours':>8s} {'NVIDIA':>8s} {'SimReady':>8s}")
    for folder in arguments.folders:
        scenes = sorted(path for path in folder.glob("scene.*") if path.suffix in (".usdc", ".usda", ".usdz"))
        assets = sorted(path for path in folder.glob("assets/*/*") if path.suffix in (".usdc", ".usda"))
        assets = [path for path in assets if path.stem == path.parent.name]
        ready = sorted(folder.glob("*/usd/*.usdc")) if (folder / "assets.json").is_file() else []
        for path in scenes if arguments.scenes else scenes + assets + ready:
            issues = {"OpenUSD": openusd(path), "ours": ours(path), "NVIDIA": nvidia(path, theirs["nvidia"])}
            if path in assets:
                issues["SimReady"] = simready(path, theirs["simready"])
            if path in ready:
                issues["SimReady"] = simready(path, theirs["simready"], whole=True)
            counts = " ".join(f"{len(found):8d}" for found in issues.values())
            print(f"{path.relative_to(folder.parents[1])!s:48s} {counts}", flush=True)
            for name, found in issues.items():
                bad += len(found)
                for issue in found:
                    print(f"    {name}: {issue}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
