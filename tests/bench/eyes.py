#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What it does to a tick of 1 ms that all of its eyes are open: the page in headless Chromium with a chart of what changes, a
scope that shows each trigger, a recorder of everything and a watch of everything, in every other window of a few seconds next to
one running node. Chromium takes most of what they take together: --no-page leaves it out, --apart keeps it off the core of the
tick, the last one, as far as a browser on the same machine can be kept away."""

import argparse
import contextlib
import os
import re
import shutil
import subprocess
import tempfile
import time

from record import Node, print_lateness


class Watched(Node):
    def eye(self, *command):
        return subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL)

    @contextlib.contextmanager
    def server(self):
        """`indurop serve` for the whole time, as the service it is; its address."""
        command = [self.tool("indurop-serve"), "--node", self.name, "--port", "0"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as child:
            try:
                yield re.search(r"https?://[^/]*/", child.stdout.readline()).group(0)
            finally:
                child.terminate()

    def eyes(self, address):
        """What opens all of them, and when it is left, closes them."""
        channels = [f"many::v{i}.a" for i in range(4)]

        @contextlib.contextmanager
        def opened():
            indurop = self.tool("indurop")
            children = [
                self.eye(indurop, "scope", *channels, "--trigger", "many::v0.a > 0", "--mode", "normal", "-o", "csv", "--node", self.name),
                self.eye(indurop, "watch", "many::*", "--hz", "10", "-o", "csv", "--node", self.name)]
            if self.options.browser:
                children.append(self.eye(*self.options.apart, self.options.browser, "--headless", "--no-sandbox", "--remote-debugging-port=0",
                                         f"--user-data-dir={self.path('browser')}", f"{address}#/plots?c={','.join(channels)}"))
            with self.recorder():
                time.sleep(self.options.settle)
                died = [child.args[:2] for child in children if child.poll() is not None]
                if died:
                    raise SystemExit(f"ended on its own: {died}")
                yield
            for child in children:
                child.terminate()
            for child in children:
                child.wait()

        return opened


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", required=True)
    parser.add_argument("--variables", type=int, default=100, help="of 16 bytes each")
    parser.add_argument("--tape", type=int, default=8, help="of the node, in MB")
    parser.add_argument("--pairs", type=int, default=20, help="of windows without and with all of them")
    parser.add_argument("--window", type=float, default=3, help="seconds")
    parser.add_argument("--settle", type=float, default=3, help="seconds until all of them have begun")
    parser.add_argument("--no-page", action="store_true")
    parser.add_argument("--apart", action="store_true")
    options = parser.parse_args()
    cores = sorted(os.sched_getaffinity(0))
    options.apart = ["taskset", "-c", ",".join(map(str, cores[:-1]))] if options.apart and len(cores) > 1 else []
    options.browser = None if options.no_page else shutil.which("chromium") or shutil.which("google-chrome")
    if not options.browser and not options.no_page:
        raise SystemExit("there is no Chromium here (package chromium); --no-page measures without")
    with tempfile.TemporaryDirectory(prefix="indurop-bench-", ignore_cleanup_errors=True) as folder:
        node = Watched(options, folder)
        with node.server() as address:
            print(f"load before: {os.getloadavg()[0]:.1f}", flush=True)
            what = "scope, recorder and watch" if options.no_page else "page, scope, recorder and watch"
            print_lateness(*node.windows(options.pairs, options.window, node.eyes(address)), what)


if __name__ == "__main__":
    main()
