#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The figures of docs/adr/0054: age of images of 30 Hz on another node when its module (1 ms) sees them, and the CPU
share of both programs. Before it, images of 62 Hz that two processes of the same node read where they are.
measure.py PROGRAMS MODULES [SECONDS]"""

import pathlib
import shutil
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))
sys.path.insert(0, str(pathlib.Path(__file__).parents[3] / "support"))
from harness import Setting, wait_for  # noqa: E402
from processes import cpu_seconds  # noqa: E402

SECONDS = float(sys.argv[3]) if len(sys.argv) > 3 else 10


def local(test):
    shutil.copy(test.build / "pools_eye.exe", test.folder / "second.exe")
    test.start_node("c", [("pools_camera.exe", "16ms"), ("pools_eye.exe", "1ms"), (test.folder / "second.exe", "1ms")])
    time.sleep(SECONDS)
    for reader in ("pools_eye.exe", "second.exe"):
        found = sorted(int(line) / 1e3 for line in (test.folder / f"ages-hd-{reader}").read_text().splitlines())
        print(f"hd, 62 Hz, read in place by {reader}: {len(found)} images, age p50 {found[len(found) // 2]:.0f} us, p99 "
              f"{found[len(found) * 99 // 100]:.0f} us")
    print(" ", test.pool("c", "pooltest::Figures::hd"))
    test.end("node-c")


def measure(test, name):
    pool = "pooltest::Figures::" + name
    test.pools("send-" + name, "a", "--send", pool)
    test.pools("receive-" + name, "b", "--receive", pool)
    ages = test.folder / f"ages-{name}-pools_eye.exe"
    wait_for(lambda: ages.read_text().count("\n") > 10, "images come")
    pids = [test.children[one + name].pid for one in ("send-", "receive-")]
    skipped, before, begin = ages.read_text().count("\n"), [cpu_seconds(pid) for pid in pids], time.monotonic()
    time.sleep(SECONDS)
    took = time.monotonic() - begin
    shares = [100 * (cpu_seconds(pid) - first) / took for pid, first in zip(pids, before)]
    found = sorted(int(line) / 1e6 for line in ages.read_text().splitlines()[skipped:])
    print(f"{name}: {len(found) / took:.1f} Hz, age p50 {found[len(found) // 2]:.1f} ms, p99 "
          f"{found[len(found) * 99 // 100]:.1f} ms, CPU of a core: sender {shares[0]:.1f} %, receiver {shares[1]:.1f} %")
    print(" ", test.counts("send-" + name)[pool], test.counts("receive-" + name)[pool])
    test.end("send-" + name)
    test.end("receive-" + name)


def main():
    with Setting() as test:
        local(test)
        test.start_node("a", [("pools_camera.exe", "33333us")])
        test.start_node("b", [("pools_eye.exe", "1ms")])
        for name in ("vga", "hd", "colour"):
            measure(test, name)


main()
