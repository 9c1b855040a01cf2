"""How far the objects of a delivered scene drift, in one number."""

from __future__ import annotations

from pat3d.check.settle import SettleReport


def mean_drift(report: SettleReport) -> float:
    """How far an engine moves the objects of a delivered scene, on average [m].

    The mean over the free objects of the largest distance of the centre of mass from where
    it was delivered, at any time of the run. Zero for a scene of fixed objects.
    """
    if not report.objects:
        return 0.0
    return sum(obj.centre_mm for obj in report.objects) / len(report.objects) / 1e3


def share_still(report: SettleReport, *, mm: float = 1.0, degrees: float = 1.0) -> float:
    """Share of the free objects that stay within `mm` and `degrees` for the whole run, between 0 and 1."""
    if not report.objects:
        return 1.0
    return 1.0 - len(report.moved(mm=mm, degrees=degrees)) / len(report.objects)
