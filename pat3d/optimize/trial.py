"""One trial of the optimisation: what a layout settles into, its loss and tilt margin, and the best of several."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from pat3d.geometry.pose import Pose
from pat3d.layout.predicates import RelationResult
from pat3d.optimize.refine import Epoch
from pat3d.scene.model import Attachment

LEAST_TILT = 2.0
"""Tilt of the ground [degrees] that a scene should stand, several times what its verification asks for."""
ENOUGH_TILT = 4.0
"""Tilt [degrees] beyond which more is not better."""
SPARE = 1.5
"""What a layout should stand over what its verification asks for: engines stand less than its outline does."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Trial:
    """One layout and what it settles into."""

    source: str
    """"layout", "balanced", "shifted", "arranged anew", "gradient" or "recentred"."""
    poses0: Mapping[str, Pose]
    """Intersection-free layout."""
    poses: Mapping[str, Pose]
    """At rest."""
    at_rest: bool
    """Whether the simulator met its tolerances."""
    loss: float
    """Semantic loss at rest [m^2]."""
    results: tuple[RelationResult, ...]
    """Every relation at rest."""
    attachments: tuple[Attachment, ...] = ()
    """What holds the things that hang."""
    least_tilt: float = LEAST_TILT
    """What it should stand [degrees]."""
    tilt_margin: float | None = None
    """Tilt that it stands [degrees], see pat3d.check.certificate.steadiness; None where that made no difference."""

    @property
    def broken(self) -> tuple[RelationResult, ...]:
        """Relations that do not hold."""
        return tuple(result for result in self.results if not result.holds)

    @property
    def satisfied(self) -> bool:
        """Everything holds, at rest."""
        return self.at_rest and not self.broken

    @property
    def steady(self) -> bool:
        """Satisfied, and not about to fall."""
        return self.satisfied and self.tilt_margin is not None and self.tilt_margin >= self.least_tilt

    @property
    def rank(self) -> tuple[int, bool, float, float]:
        """The least is best."""
        # Where everything holds, what is left of the loss (how far boxes jut out) matters less than standing firmly.
        margin = -min(self.tilt_margin or 0.0, max(ENOUGH_TILT, self.least_tilt)) if self.satisfied else 0.0
        return len(self.broken), not self.at_rest, margin, self.loss


@dataclass(frozen=True, kw_only=True, eq=False)
class Optimized:
    """The best layout found and how it was found."""

    best: Trial
    first: Trial
    """The layout as given."""
    skipped: bool
    """Whether the layout as given satisfied everything already."""
    trials: tuple[Trial, ...]
    """Everything that was settled, the layout as given first."""
    history: tuple[Epoch, ...]
    """Gradient steps in order."""

    @property
    def poses0(self) -> Mapping[str, Pose]:
        """The best initial layout."""
        return self.best.poses0

    @property
    def poses(self) -> Mapping[str, Pose]:
        """The best scene at rest."""
        return self.best.poses

    @property
    def improved(self) -> bool:
        """Whether there is a better layout than the one as given."""
        return self.best.rank < self.first.rank

    @property
    def satisfied(self) -> bool:
        """Whether every relation holds in the best scene."""
        return self.best.satisfied

    def as_dict(self) -> dict:
        """Plain data for report.json."""
        return {
            "skipped": self.skipped,
            "satisfied": self.satisfied,
            "source": self.best.source,
            "loss_before": self.first.loss,
            "loss_after": self.best.loss,
            "broken": [str(result.relation) for result in self.best.broken],
            "steadiness_degrees": self.best.tilt_margin,
            "trials": [
                {
                    "source": one.source,
                    "loss": one.loss,
                    "broken": len(one.broken),
                    "at_rest": one.at_rest,
                    "steadiness_degrees": one.tilt_margin,
                }
                for one in self.trials
            ],
            "history": [
                {"start": one.start, "epoch": one.epoch, "loss": one.loss, "broken": one.broken} for one in self.history
            ],
        }
