# SPDX-License-Identifier: Apache-2.0
"""Shared variables of an InduRoP node, by name.

    import indurop
    node = indurop.node(write=True)
    node["gain"] = 1.5
    print(node["knu::Robot::joints"][0].x)

Recordings: indurop.recording(). Boards elsewhere: indurop.remote(). Tests in virtual time: indurop.Plant.

A handle is for one thread at a time. Reading never disturbs the node. See docs/python.md."""

from indurop._deploy import deploy
from indurop._errors import (Apart, Busy, Changed, Corrupt, Denied, Error, Forced, Gone, Invalid, Locked, NotFound,
                             OtherVersion, OutOfRange, RolledBack, SystemFailure, Timeout, Unreachable, WrongSize)
from indurop._layout import Record
from indurop._library import version
from indurop._node import Node, Quality, Stream, Variable, node
from indurop._plant import Module, Plant
from indurop._recording import RecordedVariable, Recording, Samples, recording
from indurop._remote import RemoteNode, RemoteVariable, remote
from indurop._typed import TypedVariable

__all__ = ["Apart", "Busy", "Changed", "Corrupt", "Denied", "Error", "Forced", "Gone", "Invalid", "Locked", "Module",
           "Node", "NotFound", "OtherVersion", "OutOfRange", "Plant", "Quality", "Record", "RecordedVariable",
           "Recording", "RemoteNode", "RemoteVariable", "RolledBack", "Samples", "Stream", "SystemFailure", "Timeout",
           "TypedVariable", "Unreachable", "Variable", "WrongSize", "deploy", "node", "recording", "remote",
           "version"]
