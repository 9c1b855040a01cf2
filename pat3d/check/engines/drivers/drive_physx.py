"""PhysX on the CPU through ovphysx: the USD export, read with the PhysX schemas as Isaac Sim reads it."""

from __future__ import annotations

from importlib import metadata
from pathlib import Path
from typing import Any

import ovphysx
import ovstage
import recording
from ovphysx.samples.python_samples.schema_support import physx_schema_paths
from ovphysx.types import ObjectScope, SimObjectType

STEP = 0.001
"""[s], the step that the file asks for."""


def drive(export: Path, seconds: float, _: str, lean: float) -> dict[str, Any]:
    """Load scene.usdc as it is and run it."""
    roots = [*map(str, physx_schema_paths()), str(ovphysx.newton_schema_root())]
    ovstage.population.register_usd_schemas(roots)
    stage = ovstage.Stage("scene")
    domains = ovstage.PopulationDomain.ALL
    ovstage.population.open_usd(stage, str(export / "scene.usdc"), ordinal=1, domains=domains)
    stage.advance_write_floor(ordinal=1).wait()
    physx = ovphysx.PhysX()
    physx.wait_task(physx.attach_ovstage(stage, read_ordinal=1))

    def poses() -> dict[str, list[float]]:
        found: dict[str, dict[str, Any]] = {}
        scope = ObjectScope.ALL
        with physx.read_sync(SimObjectType.RIGID_BODY, ["position", "orientation"], scope=scope) as result:
            for group in result.groups:
                attribute = result.dictionary.token_to_string(group.attribute)
                rows = [row for tensor in group.tensors for row in tensor.numpy().tolist()]
                paths = result.dictionary.get_path_strings(group.prim_list)
                found[attribute] = {str(path).split("/")[-1]: row for path, row in zip(paths, rows, strict=True)}
        turns = found["orientation"]
        # Quaternions come scalar last.
        return {name: [*place, turns[name][3], *turns[name][:3]] for name, place in found["position"].items()}

    def step(count: int) -> None:
        for _ in range(count):
            physx.step_sync(STEP)

    found = recording.run(step, poses, STEP, seconds, None, lean)
    physx.wait_task(physx.detach_ovstage())
    return {
        "engine": "PhysX",
        "version": f"ovphysx {metadata.version('ovphysx')}",
        "settings": {"timestep": STEP},
        "warnings": [],
        "recording": found,
    }


if __name__ == "__main__":
    recording.main(drive)
