#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The page says for each error of the robot task what to do: way_out_test.py plc_robot.glb way_out.ts"""

import pathlib
import re
import sys


def main():
    glb, page = (pathlib.Path(name).read_text() for name in sys.argv[1:])
    errors = set(re.findall(r"^\s*(ROBOT_ERR_\w+)", glb[glb.index("enum ROBOT_ERROR {"):].partition("};")[0], re.MULTILINE))
    known = set(re.findall(r"^\s*(ROBOT_ERR_\w+): \"", page, re.MULTILINE))
    for name in sorted(errors ^ known):
        print(f"{name}: {'the page does not say what to do' if name in errors else 'no such error in the .glb file'}")
    return 1 if errors != known or len(errors) < 30 else 0


if __name__ == "__main__":
    sys.exit(main())
