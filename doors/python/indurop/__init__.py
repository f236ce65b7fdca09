# SPDX-License-Identifier: Apache-2.0
"""Shared variables of an InduRoP node, by name.

    import indurop
    node = indurop.node(write=True)
    node["gain"] = 1.5
    print(node["knu::Robot::joints"][0].x)

A handle is for one thread at a time. Reading never disturbs the node. See docs/python.md."""

from indurop._errors import (Apart, Busy, Changed, Corrupt, Denied, Error, Forced, Gone, Invalid, Locked, NotFound,
                             OtherVersion, OutOfRange, SystemFailure, Timeout, Unreachable, WrongSize)
from indurop._layout import Record
from indurop._library import version
from indurop._node import Node, Quality, Stream, Variable, node
from indurop._recording import RecordedVariable, Recording, Samples, recording
from indurop._remote import RemoteNode, RemoteVariable, remote

__all__ = ["Apart", "Busy", "Changed", "Corrupt", "Denied", "Error", "Forced", "Gone", "Invalid", "Locked", "Node",
           "NotFound", "OtherVersion", "OutOfRange", "Quality", "Record", "RecordedVariable", "Recording",
           "RemoteNode", "RemoteVariable", "Samples", "Stream", "SystemFailure", "Timeout", "Unreachable", "Variable",
           "WrongSize", "node", "recording", "remote", "version"]
