#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Packs the lag as an FMU: make_lag.py VERSION LIBRARY DESCRIPTION OUTPUT"""

import os
import platform
import sys
import zipfile

version, library, description, output = sys.argv[1:]
machine = platform.machine()
folder = "linux64" if version == "2" and machine == "x86_64" else machine + "-linux"
os.makedirs(os.path.dirname(output), exist_ok=True)
with zipfile.ZipFile(output, "w", zipfile.ZIP_DEFLATED) as fmu:
    fmu.write(description, "modelDescription.xml")
    fmu.write(library, f"binaries/{folder}/lag.so")
    fmu.writestr("resources/data.txt", "Data of the lag\n")
    fmu.writestr("documentation/index.html", "<p>A first-order lag</p>\n")
