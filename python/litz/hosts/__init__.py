"""Models for other programs, some with the contact element of litz as a user element (`docs/user_element.md`)."""

from .host_model import HostModel, read_host_model
from .write_abaqus import abaqus_input
from .write_ccx import ccx_input, missing_in_ccx
from .write_feap import feap_input

__all__ = ["HostModel", "abaqus_input", "ccx_input", "feap_input", "missing_in_ccx", "read_host_model"]
