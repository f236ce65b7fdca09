#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Store to store between two boards, in turn with ddsperf's ping between the same two network namespaces. Needs root.
Only figures of one round are compared with each other; what is printed is the median over the rounds."""

import argparse
import json
import os
import re
import statistics
import subprocess
import time

XML = ('<General><Interfaces><NetworkInterface name="eth0"/></Interfaces><AllowMulticast>spdp</AllowMulticast></General>'
       "<Internal><MultipleReceiveThreads>false</MultipleReceiveThreads></Internal>")


class Boards:
    def __init__(self, lab, programs):
        self.lab = [lab, "-l", f"bench{os.getpid()}"]
        self.bench = os.path.join(os.path.abspath(programs), "mirror_bench")
        self.domain = str(100 + os.getpid() % 100)

    def __enter__(self):
        subprocess.run([*self.lab, "up", "a", "b"], check=True)
        return self

    def __exit__(self, *_):
        subprocess.run([*self.lab, "down"], check=False)

    def start(self, board, command, **options):
        return subprocess.Popen([*self.lab, "exec", board, *command], stdout=subprocess.PIPE, text=True, **options)

    def mirror(self, seconds, size, count):
        reader = self.start("b", [self.bench, "read", self.domain, str(seconds), str(size), str(count)])
        writer = self.start("a", [self.bench, "write", self.domain, str(seconds + 1), str(size), str(count)])
        read = json.loads(reader.communicate(timeout=seconds + 60)[0])
        return {**json.loads(writer.communicate(timeout=60)[0]), **read}

    def ddsperf(self, seconds, size):
        """p50 and p99 of half a round trip in us, each the median of the program's report lines."""
        environment = {**os.environ, "CYCLONEDDS_URI": f"<CycloneDDS><Domain>{XML}</Domain></CycloneDDS>"}
        duration = str(seconds + 2)
        pong = self.start("b", ["ddsperf", "-i", self.domain, "-D", duration, "pong"], env=environment)
        ping = self.start("a", ["ddsperf", "-i", self.domain, "-D", duration, "ping", "1000", "size", str(size)],
                          env=environment)
        text = ping.communicate(timeout=seconds + 60)[0]
        pong.communicate(timeout=60)
        lines = [re.findall(r"(\d+(?:\.\d+)?)us", line) for line in text.splitlines() if "us" in line]
        found = [[float(x) for x in line] for line in lines if len(line) >= 5][1:]
        return statistics.median(f[2] for f in found), statistics.median(f[4] for f in found), text


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--programs", required=True)
    parser.add_argument("--lab", required=True)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=int, default=5)
    parser.add_argument("--verbose", action="store_true")
    arguments = parser.parse_args()
    # Both sides under the same condition: idle states held short, as a node does.
    latency_file = os.open("/dev/cpu_dma_latency", os.O_WRONLY)
    os.write(latency_file, (0).to_bytes(4, "little"))
    with Boards(arguments.lab, arguments.programs) as boards:
        latency = []
        for _ in range(arguments.rounds):
            ours = boards.mirror(arguments.seconds, 256, 1)
            p50, p99, text = boards.ddsperf(arguments.seconds, 256)
            if arguments.verbose:
                print(text, ours)
            latency.append((ours["p50_us"], p50, ours["p99_us"], p99))
            time.sleep(0.2)
        median = [statistics.median(row[i] for row in latency) for i in range(4)]
        print(f"store to store, 256 B: p50 {median[0]:.1f} us, ddsperf's half round trip {median[1]:.1f} us, "
              f"ratio {median[0] / median[1]:.2f} (target 1.3)")
        print(f"                       p99 {median[2]:.1f} us, ddsperf {median[3]:.1f} us, "
              f"ratio {median[2] / median[3]:.2f} (target 2)")
        alone, combined, many = [], [], None
        for _ in range(arguments.rounds):
            writer = boards.start("a", [boards.bench, "alone", boards.domain, str(arguments.seconds), "16", "500"])
            alone.append(json.loads(writer.communicate(timeout=arguments.seconds + 60)[0])["late_p99_us"])
            many = boards.mirror(arguments.seconds, 16, 500)
            combined.append(many["late_p99_us"])
        print(f"500 variables of 16 B at 1 kHz: {many['mirror_us_per_tick']:.0f} us of mirror per tick (target 80), "
              f"{many['lost']} updates lost, p50 {many['p50_us']:.1f} us, p99 {many['p99_us']:.1f} us")
        with_it, without = statistics.median(combined), statistics.median(alone)
        print(f"the writer's p99 lateness at 1 ms: {with_it:.1f} us, without a mirror {without:.1f} us, "
              f"ratio {with_it / without:.2f} (target 1.1)")


if __name__ == "__main__":
    main()
