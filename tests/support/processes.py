# SPDX-License-Identifier: Apache-2.0
"""What programs of tests and benchmarks take of the machine."""

import os
import pathlib
import socket


def cpu_seconds(pid):
    """The processor time of a process, all its threads."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]
