"""Scenes as Gymnasium environments: "PAT3D-v0"."""

import sys

from pat3d.envs.registration import register_with_gymnasium

if "gymnasium" in sys.modules:
    register_with_gymnasium()
