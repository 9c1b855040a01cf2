"""An audit of a plan against its sentence that knows nothing of how the plan was made."""
