"""What single engines read beyond UsdPhysics: PhysX, Newton and MuJoCo. A reader that knows none of it sees plain USD.

The applied schemas need not be installed where the file is written; their attributes have the names and types of
physx-usd-schemas 25.11, newton-usd-schemas 0.6 and MuJoCo's mjcPhysics. Two hulls a hundredth of a millimetre apart
must neither be pushed apart (rest offset, depenetration velocity) nor thickened (least hull thickness).
"""

from __future__ import annotations

from typing import Any

from pat3d.exporters.mjcf.elements import CONDIM, ROLLING_FRICTION, SOLIMP, SOLREF, TORSIONAL_FRICTION
from pat3d.exporters.mjcf.writer import CCD_TOLERANCE, TIMESTEP
from pat3d.exporters.usd.openusd import Prim, Sdf

STEPS_PER_SECOND = 1000
"""Of PhysX and Newton [1/s]."""

CONTACT_OFFSET = 1e-4
"""PhysX looks for contacts between surfaces closer than the sum of two of these [m].

More than the gaps of a scene at rest, and not much more: where two edges cross, PhysX takes the nearest face instead if
it is within reach, and what leans on a rim meets it at an angle that its friction may not hold (a pen slid by 4 mm).
What comes faster than this in a step is found ahead of time, by speculative contacts.
"""

CONTACT_GAP = 0.0
"""Newton looks for contacts between surfaces closer than this [m].

Its MuJoCo solver lets points that are open by less take the place of points that carry: of a face it keeps four. With
2 mm a tower fell at three quarters of the tilt that its outline stands, a pencil with a hundredth of a millimetre.
"""

MAX_DEPENETRATION_VELOCITY = 0.1
"""[m/s], at which PhysX pushes overlapping bodies apart."""

MIN_HULL_THICKNESS = 1e-5
"""PhysX inflates hulls thinner than this [m]; its default of a millimetre would change paper and blades."""

MAX_HULL_VERTICES = 64

_FLOAT, _INT, _UINT = Sdf.ValueTypeNames.Float, Sdf.ValueTypeNames.Int, Sdf.ValueTypeNames.UInt
_BOOL, _TOKEN = Sdf.ValueTypeNames.Bool, Sdf.ValueTypeNames.Token
_DOUBLE, _DOUBLES = Sdf.ValueTypeNames.Double, Sdf.ValueTypeNames.DoubleArray
_UNIFORM, _VARYING = Sdf.VariabilityUniform, Sdf.VariabilityVarying


def extend_scene(prim: Prim) -> None:
    """Solver settings on the PhysicsScene `prim`; MuJoCo's are those of the MJCF export."""
    _apply(prim, "PhysxSceneAPI", [("physxScene:timeStepsPerSecond", _UINT, STEPS_PER_SECOND, _VARYING)])
    _apply(prim, "NewtonSceneAPI", [("newton:timeStepsPerSecond", _INT, STEPS_PER_SECOND, _UNIFORM)])
    _apply(
        prim,
        "MjcSceneAPI",
        [
            ("mjc:option:timestep", _DOUBLE, TIMESTEP, _UNIFORM),
            ("mjc:option:integrator", _TOKEN, "implicitfast", _UNIFORM),
            ("mjc:option:cone", _TOKEN, "elliptic", _UNIFORM),
            ("mjc:option:impratio", _DOUBLE, 10.0, _UNIFORM),
            ("mjc:option:ccd_tolerance", _DOUBLE, CCD_TOLERANCE, _UNIFORM),
            ("mjc:flag:multiccd", _BOOL, True, _UNIFORM),
        ],
    )


def extend_body(prim: Prim) -> None:
    """Settings of a rigid body."""
    _apply(
        prim,
        "PhysxRigidBodyAPI",
        [
            ("physxRigidBody:maxDepenetrationVelocity", _FLOAT, MAX_DEPENETRATION_VELOCITY, _VARYING),
            ("physxRigidBody:enableSpeculativeCCD", _BOOL, True, _VARYING),
        ],
    )


def shorten_body(prim: Prim) -> None:
    """Take the schema of `extend_body` from a prim that is no rigid body after all."""
    prim.RemoveAppliedSchema("PhysxRigidBodyAPI")


def extend_collider(prim: Prim, *, mesh: bool) -> None:
    """Settings of a collider; `mesh` for convex hulls, else a primitive shape."""
    _apply(
        prim,
        "PhysxCollisionAPI",
        [
            ("physxCollision:contactOffset", _FLOAT, CONTACT_OFFSET, _VARYING),
            ("physxCollision:restOffset", _FLOAT, 0.0, _VARYING),
        ],
    )
    _apply(
        prim,
        "NewtonCollisionAPI",
        [
            ("newton:contactGap", _FLOAT, CONTACT_GAP, _VARYING),
        ],
    )
    _apply(
        prim,
        "MjcCollisionAPI",
        [
            ("mjc:group", _INT, 3, _UNIFORM),
            ("mjc:condim", _INT, int(CONDIM), _UNIFORM),
            ("mjc:solref", _DOUBLES, _numbers(SOLREF), _UNIFORM),
            # All five: MuJoCo's reader takes no shorter list.
            ("mjc:solimp", _DOUBLES, [*_numbers(SOLIMP), 0.5, 2.0], _UNIFORM),
        ],
    )
    if mesh:
        _apply(
            prim,
            "PhysxConvexHullCollisionAPI",
            [
                ("physxConvexHullCollision:hullVertexLimit", _INT, MAX_HULL_VERTICES, _VARYING),
                ("physxConvexHullCollision:minThickness", _FLOAT, MIN_HULL_THICKNESS, _VARYING),
            ],
        )
        _apply(prim, "NewtonMeshCollisionAPI", [("newton:maxHullVertices", _INT, -1, _UNIFORM)])
        _apply(prim, "MjcMeshCollisionAPI", [("mjc:inertia", _TOKEN, "convex", _UNIFORM)])


def extend_margin(prim: Prim, margin: float) -> None:
    """The contact margin of an extended collider [m], for MuJoCo, in which surfaces so far apart feel each other.

    Newton gets none: its position-based solver takes what is closer for overlap and undoes it in one time step, 3 um in
    1 ms, so that leaning toothbrushes slid by 1 to 2 mm.
    """
    prim.CreateAttribute("mjc:margin", _DOUBLE, False, _UNIFORM).Set(margin)


def extend_joint(prim: Prim) -> None:
    """Make a joint a connect constraint of MuJoCo's between bodies that stay free, as stiff as the contacts."""
    prim.AddAppliedSchema("MjcEqualityConnectAPI")
    stiffness = [
        ("mjc:solref", _DOUBLES, _numbers(SOLREF), _UNIFORM),
        ("mjc:solimp", _DOUBLES, [*_numbers(SOLIMP), 0.5, 2.0], _UNIFORM),
    ]
    _apply(prim, "MjcEqualityAPI", stiffness)


def extend_material(prim: Prim) -> None:
    """Friction beyond Coulomb's on a physics material, and the rule by which a pair takes the larger friction."""
    _apply(prim, "PhysxMaterialAPI", [("physxMaterial:frictionCombineMode", _TOKEN, "max", _UNIFORM)])
    _apply(
        prim,
        "NewtonMaterialAPI",
        [
            ("newton:torsionalFriction", _FLOAT, TORSIONAL_FRICTION, _VARYING),
            ("newton:rollingFriction", _FLOAT, ROLLING_FRICTION, _VARYING),
        ],
    )
    _apply(
        prim,
        "MjcMaterialAPI",
        [
            ("mjc:torsionalfriction", _DOUBLE, TORSIONAL_FRICTION, _UNIFORM),
            ("mjc:rollingfriction", _DOUBLE, ROLLING_FRICTION, _UNIFORM),
        ],
    )


def _apply(prim: Prim, schema: str, attributes: list[tuple[str, Any, Any, Any]]) -> None:
    """Apply `schema` and author (name, type, value, variability) of its attributes."""
    prim.AddAppliedSchema(schema)
    for name, kind, value, variability in attributes:
        prim.CreateAttribute(name, kind, False, variability).Set(value)


def _numbers(text: str) -> list[float]:
    return [float(word) for word in text.split()]
