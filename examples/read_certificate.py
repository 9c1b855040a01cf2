"""What a verified scene promises: its equilibrium certificate and the other checks, as numbers.

The certificate comes from contact forces inside the friction cones that balance gravity on every object. It does not
use the simulator that settled the scene.

    python examples/read_certificate.py          # writes scenes/cup
"""

import json
from pathlib import Path

import pat3d
from pat3d.check.certificate import certify

pat3d.generate("A white cup holds two toothbrushes, beside a bar of soap.", out="scenes/cup", seed=0)

# report.json keeps what was found when the scene was made; `pat3d check scenes/cup` finds it again.
report = json.loads(Path("scenes/cup/report.json").read_text())
found = report["verification"]
print("passed:", report["passed"])
print(
    "intersecting pairs:",
    len(found["penetration"]["hulls"]),
    "of hulls,",
    len(found["penetration"]["visuals"]),
    "of surfaces",
)
print(f"largest drift in MuJoCo: {found['mujoco']['worst_mm']:.3f} mm")
print("relations that hold:", found["relations"]["held"], "of", found["relations"]["count"])

# The certificate alone, at a friction coefficient of your choice.
scene = pat3d.load_scene("scenes/cup")
certificate = certify(scene, friction=0.3, margin=True)
for name, residual in certificate.residuals.items():
    print(f"{name}: unbalanced by {residual:.1e} of its weight")
print(f"balanced down to a friction coefficient of {certificate.smallest_friction:.3f}")
first = ", ".join(certificate.first_to_go) or "nothing, up to the largest tilt that is tried"
print(f"stands a tilt of {certificate.largest_tilt:.2f} degrees; first to slide or tip: {first}")
