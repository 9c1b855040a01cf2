"""What still stands when a scene is simulated otherwise than it was verified: other integrators, solvers, cones, steps.

The verification holds for the options that the export states. People change them: a policy wants 5 ms, a framework
sets its own contact parameters. Every variant here changes one thing of the file, the last one everything at once.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

from pat3d.check.settle import Change, SettleReport, settle_in_mujoco
from pat3d.errors import SpecError
from pat3d.progress import Event, Progress, silent
from pat3d.scene.physics import STILL_SECONDS

DEFAULT_SOLREF = (0.02, 1.0)
"""MuJoCo's time constant [s] and damping ratio of contacts."""

DEFAULT_SOLIMP = (0.9, 0.95, 0.001, 0.5, 2.0)
"""MuJoCo's impedance of contacts."""


@dataclass(frozen=True, kw_only=True)
class Setting:
    """One way to simulate the scene."""

    name: str
    """As users type it."""
    title: str
    change: Change


@dataclass(frozen=True, kw_only=True)
class SettingReport:
    """How the scene fared under one setting."""

    setting: Setting
    report: SettleReport


def _option(name: str, enum: str, member: str) -> Change:
    def change(model: Any) -> None:
        mujoco: Any = import_module("mujoco")
        setattr(model.opt, name, getattr(getattr(mujoco, enum), member))

    return change


def _integrator(member: str) -> Change:
    return _option("integrator", "mjtIntegrator", member)


def _timestep(seconds: float) -> Change:
    def change(model: Any) -> None:
        model.opt.timestep = seconds

    return change


def _default_contacts(model: Any) -> None:
    """MuJoCo's contact parameters on everything that the file makes stiffer."""
    model.geom_solref[:], model.geom_solimp[:] = DEFAULT_SOLREF, DEFAULT_SOLIMP
    model.eq_solref[:], model.eq_solimp[:] = DEFAULT_SOLREF, DEFAULT_SOLIMP


def _no_margins(model: Any) -> None:
    model.geom_margin[:] = 0.0


def _impratio(model: Any) -> None:
    model.opt.impratio = 1.0


def _everything(model: Any) -> None:
    """What a file without options and contact parameters would be simulated with."""
    for setting in ("integrator-euler", "cone-pyramidal", "impratio-1", "contacts-default", "margin-0"):
        SETTINGS[setting].change(model)
    model.opt.ccd_tolerance = 1e-6


_INTEGRATORS = {"euler": "mjINT_EULER", "rk4": "mjINT_RK4", "implicit": "mjINT_IMPLICIT"}
_SOLVERS = {"cg": "mjSOL_CG", "pgs": "mjSOL_PGS"}

_ALL = (
    *(
        Setting(
            name=f"integrator-{name}", title=f"integrator {name}", change=_option("integrator", "mjtIntegrator", it)
        )
        for name, it in _INTEGRATORS.items()
    ),
    *(
        Setting(name=f"solver-{name}", title=f"solver {name}", change=_option("solver", "mjtSolver", member))
        for name, member in _SOLVERS.items()
    ),
    Setting(name="cone-pyramidal", title="pyramidal cone", change=_option("cone", "mjtCone", "mjCONE_PYRAMIDAL")),
    *(
        Setting(name=f"timestep-{1e3 * step:g}ms", title=f"time step {1e3 * step:g} ms", change=_timestep(step))
        for step in (0.001, 0.005)
    ),
    Setting(name="impratio-1", title="impratio 1", change=_impratio),
    Setting(name="margin-0", title="no contact margins", change=_no_margins),
    Setting(name="contacts-default", title="MuJoCo's solref and solimp", change=_default_contacts),
    Setting(name="defaults", title="MuJoCo's defaults for all of these", change=_everything),
)

SETTINGS: dict[str, Setting] = {setting.name: setting for setting in _ALL}


def chosen_settings(names: Iterable[str]) -> tuple[Setting, ...]:
    """The settings that `names` name, each once; commas within a name separate, "all" is all of them.

    Raises:
        SpecError: a name that is no setting's.
    """
    wanted: list[str] = []
    for name in (word.strip().lower() for words in names for word in words.split(",")):
        if name != "all" and name not in SETTINGS:
            raise SpecError(f'unknown setting "{name}". Valid: {", ".join(SETTINGS)}, all.')
        wanted += SETTINGS if name == "all" else (name,)
    return tuple(SETTINGS[name] for name in dict.fromkeys(wanted))


def check_settings(
    mjcf_path: str | Path,
    settings: Iterable[Setting],
    *,
    seconds: float = STILL_SECONDS,
    progress: Progress = silent,
) -> tuple[SettingReport, ...]:
    """Simulate the file as it is written, then under each of `settings`.

    Raises:
        CheckError: MuJoCo refuses the file.
    """
    as_written = Setting(name="as-written", title="as written", change=lambda _: None)
    every = (as_written, *settings)
    reports = []
    for number, setting in enumerate(every):
        progress(Event(stage="settings", detail=setting.title, step=number, steps=len(every)))
        reports.append(
            SettingReport(setting=setting, report=settle_in_mujoco(mjcf_path, seconds, change=setting.change))
        )
    return tuple(reports)
