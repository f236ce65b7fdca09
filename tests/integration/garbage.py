#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A flood of garbage, half of it with the head of an RTPS message, at the DDS ports of a host: garbage.py HOST DOMAIN [DATAGRAMS]"""

import os
import random
import socket
import sys


def main():
    host, domain = sys.argv[1], int(sys.argv[2])
    left = int(sys.argv[3]) if len(sys.argv) > 3 else -1  # else until somebody ends it
    flood = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    ports = [7400 + 250 * domain + i for i in (0, 1, *range(10, 22))]
    while left != 0:
        left -= 1
        head = b"RTPS" if left % 2 else b""
        try:
            flood.sendto(head + os.urandom(random.randrange(0, 1400)), (host, random.choice(ports)))
        except OSError:
            pass  # nobody listens there
    return 0


if __name__ == "__main__":
    sys.exit(main())
