#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How late a thread of LinuxCNC (uspace) begins, from the times between its own calls. linuxcnc.py PERIOD_US SECONDS CORE

Debian's package is fetched and unpacked, not installed: it would bring a hundred others for its screen. It is seen in place of
this machine's /usr for the time of the run. Needs root, and mounts in a namespace of its own."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

PACKAGE = "linuxcnc-uspace"
# A container may refuse what the threads do not need: ports of the processor, limits that hold already.
REFUSED = """int iopl(int level) { return level * 0; }
int setrlimit(int what, const void* limit) { return limit == 0 ? what * 0 : 0; }
int setrlimit64(int what, const void* limit) { return limit == 0 ? what * 0 : 0; }
"""
HAL = """loadrt threads name1=tick period1={period_ns}
loadrt timedelta
loadrt sampler depth=16000 cfg=s
net since timedelta.0.out => sampler.0.pin.0
addf timedelta.0 tick
addf sampler.0 tick
start
loadusr -w halsampler -c 0 -n {count} {out}
"""


def fetch():
    """The unpacked package; None without a network."""
    folder = pathlib.Path(os.environ.get("XDG_CACHE_HOME", pathlib.Path.home() / ".cache")) / "indurop" / PACKAGE
    if not folder.is_dir():
        with tempfile.TemporaryDirectory() as into:
            if subprocess.run(["apt-get", "-q", "download", PACKAGE], cwd=into, capture_output=True, check=False).returncode:
                return None
            folder.parent.mkdir(parents=True, exist_ok=True)
            subprocess.run(["dpkg-deb", "-x", *pathlib.Path(into).glob("*.deb"), folder], check=True)
    return folder


def times_between(root, period_ns, count, core):
    """Nanoseconds between calls, as its own component tells them."""
    with tempfile.TemporaryDirectory(dir="/tmp") as folder:
        os.chmod(folder, 0o777)  # it gives up root
        at = pathlib.Path(folder)
        (at / "refused.c").write_text(REFUSED)
        subprocess.run(["cc", "-shared", "-fPIC", "-fno-builtin", "-o", at / "refused.so", at / "refused.c"], check=True)
        (at / "run.hal").write_text(HAL.format(period_ns=period_ns, count=count, out=at / "out"))
        layers = " && ".join(f"mount -t overlay overlay -o lowerdir={root}/{name}:/{name} /{name}" for name in ("usr", "etc"))
        done = subprocess.run(["unshare", "-m", "sh", "-c", f"{layers} && exec halrun -f {at}/run.hal"], capture_output=True,
                              text=True, check=False,
                              env={**os.environ, "LD_PRELOAD": str(at / "refused.so"), "LINUXCNC_FORCE_REALTIME": "1",
                                   "RTAPI_UID": "65534", "RTAPI_FIFO_PATH": str(at / "fifo"), "RTAPI_CPU_NUMBER": str(core)})
        if "POSIX realtime" not in done.stderr or not (at / "out").exists():
            raise RuntimeError(f"LinuxCNC did not run in real time:\n{done.stderr}")
        words = [line.split() for line in (at / "out").read_text().splitlines()]
        return [int(line[-1]) for line in words if line][1:]  # the first call has none before it


def lateness(between, period_ns):
    """p50, p99 and the share of lost periods. The grid is the one on which the earliest call is not late."""
    late, at = [], 0
    for time in between:
        at += time - period_ns
        late.append(at)
    late = sorted(value - min(late) for value in late)
    return {"p50": late[len(late) // 2], "p99": late[len(late) * 99 // 100],
            "lost": sum(value >= period_ns for value in late) / len(late)}


def main():
    period_us, seconds, core = (int(word) for word in sys.argv[1:])
    root = fetch()
    if not root or os.geteuid() != 0:
        return 77
    print(json.dumps(lateness(times_between(root, period_us * 1000, seconds * 1_000_000 // period_us, core), period_us * 1000)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
