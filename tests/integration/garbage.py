#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A flood of garbage, half of it with the head of an RTPS message, at the DDS ports of a host: garbage.py HOST DOMAIN [DATAGRAMS]
About 5000 datagrams a second: without a limit three floods take both cores of a small machine
from the programs that are tested."""

import os
import random
import socket
import sys
import time


BURST = 10
PAUSE = 0.002  # s


def main():
    host, domain = sys.argv[1], int(sys.argv[2])
    left = int(sys.argv[3]) if len(sys.argv) > 3 else -1  # else until it is killed
    flood = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    ports = [7400 + 250 * domain + i for i in (0, 1, *range(10, 22))]
    while left != 0:
        left -= 1
        head = b"RTPS" if left % 2 else b""
        try:
            flood.sendto(head + os.urandom(random.randrange(0, 1400)), (host, random.choice(ports)))
        except OSError:
            pass  # no program listens there
        if left % BURST == 0:
            time.sleep(PAUSE)
    return 0


if __name__ == "__main__":
    sys.exit(main())
