"""The local step on different machinery, behind one interface: see `NumpyLocalStep`."""

from .choice import DEVICES, local_step_class

__all__ = ["DEVICES", "local_step_class"]
