"""The errors that PAT3D raises on purpose.

A message says what was wrong, where, and what would have been valid. The command line prints it
without a traceback and exits with the class's `exit_code`: 2 for what the user can fix, 1 for a
scene that failed a check.
"""


class Pat3dError(Exception):
    """Base class of every error that PAT3D raises on purpose."""

    exit_code = 2


class PromptError(Pat3dError):
    """The prompt cannot be planned: an unknown noun, an impossible count, nothing to place."""


class ModelError(Pat3dError):
    """A language model is not set up, cannot be reached, or gives no answer that can be used."""


class AnswerError(ModelError):
    """One answer of a language model is not what was asked for; the model is told and may answer again."""


class SpecError(Pat3dError):
    """A scene specification or a scene file is invalid."""


class AssetError(Pat3dError):
    """A mesh or a catalogue object cannot be made or used."""


class LayoutError(Pat3dError):
    """No arrangement without intersection was found, or an object does not fit where it belongs."""


class EditError(Pat3dError):
    """An edit of a scene that names what is not there, or that the scene would not stand."""


class SimulationError(Pat3dError):
    """The simulator was given an invalid state or could not converge."""

    exit_code = 1


class CpuLimitError(Pat3dError):
    """The processor time that a run was given is spent."""


class ExportError(Pat3dError):
    """A scene cannot be written to, or read back from, an exchange format."""


class CheckError(Pat3dError):
    """A scene failed its verification: certificate, penetration or settling."""

    exit_code = 1


class EnvironmentSetupError(Pat3dError):
    """A scene, task, robot or option from which no environment can be made."""


class UnsettledSceneError(Pat3dError):
    """A scene that moves when MuJoCo loads it; nothing may be measured on it."""

    exit_code = 1


class TaskError(Pat3dError):
    """A task that its scene does not allow: done already, out of reach, or too wide for the gripper."""


class SuiteError(Pat3dError):
    """A suite that cannot be made, found or used: damaged, locked, or asked for what it does not have."""


class EvaluationError(Pat3dError):
    """An evaluation, a policy or a record of one that cannot be used."""


class InfrastructureError(EvaluationError):
    """What evaluates failed, not the policy: a broken installation, an environment that raises, a process that died."""

    exit_code = 1
