#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Types a page of the documentation as a reader does, and fails where a command does. type_page.py PAGE BUILD FOLDER

Which blocks of the page are typed is said behind the language:
    ```console typed          lines after "$ " are commands; each has to end with exit code 0
    ```console typed exit=4   the last command has to end with this code
    ```console typed may=6    any command may end with this code, too
    ```console typed stays    the last command stays in the foreground of its terminal until the page ends, then gets Ctrl-C
    ```console typed in=two   in the terminal of this name, not in the first; terminals begin in the top folder
    ```console typed ends=a,b the terminals of these names get Ctrl-C before
    ```console typed root     needs root: left out without it, like all that follow in the same section
    ```cpp file=src/a.cpp     the block is the new content of this file, in the folder where the first terminal is
    ```xml file=a.xml add=TEXT  the block goes before the first line of the file that has TEXT
A command that does not reach its node (exit code 6) is typed again for some seconds: what it needs may still be starting.
The top folder is empty but for `build`, the build tree with a copy of its examples. The page has processes, /dev/shm, /tmp/boards and network to itself."""

import ctypes
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import threading
import time

BLOCK = re.compile(r"^```(\w+)[ \t]+((?:typed|file=)[^\n]*)\n(.*?)^```", re.MULTILINE | re.DOTALL)
PATIENCE = 120  # s for one command: far beyond what any needs
AGAIN = 20      # s in which an unreachable node is asked again
SKIPPED = 77


class Terminal:
    def __init__(self, top, environment):
        self.bash = subprocess.Popen(["bash", "--norc", "--noprofile"], cwd=top, env=environment, text=True, bufsize=1,
                                     stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.lines = []
        self.news = threading.Condition()
        threading.Thread(target=self.listen, daemon=True).start()
        self.stays = None

    def listen(self):
        for line in self.bash.stdout:
            with self.news:
                self.lines.append(line.rstrip("\n"))
                self.news.notify_all()

    def begin(self, command):
        with self.news:
            self.at = len(self.lines)
        self.bash.stdin.write(command + '\necho "<ended $?>"\n')
        self.bash.stdin.flush()

    def output(self):
        return "\n".join(self.lines[self.at:])

    def wait(self, condition):
        with self.news:
            return self.news.wait_for(condition, PATIENCE)

    def code(self):
        """Of the command that was begun, None while it runs."""
        for line in self.lines[self.at:]:
            if found := re.search(r"<ended (\d+)>$", line):
                return int(found.group(1))
        return None

    def type(self, command):
        self.begin(command)
        if not self.wait(lambda: self.code() is not None):
            raise SystemExit(f"{command}: has not ended after {PATIENCE} s:\n{self.output()}")
        return self.code()

    def leave(self, command):
        self.begin(command)
        if not self.wait(lambda: len(self.lines) > self.at) or self.code() is not None:
            raise SystemExit(f"{command}: did not stay:\n{self.output()}")
        self.stays = command

    def interrupt(self):
        """Ctrl-C, as the foreground job gets it."""
        children = pathlib.Path(f"/proc/{self.bash.pid}/task/{self.bash.pid}/children").read_text().split()
        for child in children:
            os.kill(int(child), signal.SIGINT)
        if not self.wait(lambda: self.code() is not None):
            raise SystemExit(f"{self.stays}: has not ended after Ctrl-C:\n{self.output()}")
        if self.code() not in (0, 130):
            raise SystemExit(f"{self.stays}: ended with {self.code()} after Ctrl-C:\n{self.output()}")
        self.stays = None

    def folder(self):
        return pathlib.Path(os.readlink(f"/proc/{self.bash.pid}/cwd"))


def commands(text):
    """Lines after "$ ", each with those after "> " that go on with it."""
    found = []
    for line in text.splitlines():
        if line.startswith("$ "):
            found.append(line[2:])
        elif line.startswith("> ") and found:
            found[-1] += "\n" + line[2:]
    return found


class Reader:
    def __init__(self, top, environment):
        self.top = top
        self.environment = environment
        self.terminals = {}

    def terminal(self, name):
        if name not in self.terminals:
            self.terminals[name] = Terminal(self.top, self.environment)
        return self.terminals[name]

    def put(self, options, text):
        path = self.terminal("one").folder() / options["file"]
        if "add" in options:
            lines = path.read_text().splitlines(keepends=True)
            at = next(i for i, line in enumerate(lines) if options["add"] in line)
            text = "".join(lines[:at]) + text + "".join(lines[at:])
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def type(self, options, text):
        for name in options.get("ends", "").split(","):
            if name in self.terminals and self.terminals[name].stays is not None:
                self.terminals[name].interrupt()
        terminal = self.terminal(options.get("in", "one"))
        typed = commands(text)
        for number, command in enumerate(typed):
            last = number == len(typed) - 1
            if command.startswith("cd build/"):
                terminal.type(f"cd '{self.top}'")
            print("$", command, flush=True)
            if last and "stays" in options:
                terminal.leave(command)
                continue
            wanted = int(options.get("exit", 0)) if last else 0
            allowed = {wanted, int(options.get("may", wanted))}
            end = time.monotonic() + AGAIN
            code = terminal.type(command)
            while code not in allowed and code == 6 and time.monotonic() < end:
                time.sleep(0.2)
                code = terminal.type(command)
            print(terminal.output(), flush=True)
            if code not in allowed:
                raise SystemExit(f"exit code {code}, not {wanted}: {command}")

    def end(self):
        for terminal in self.terminals.values():
            if terminal.stays is not None:
                terminal.interrupt()


def blocks(page):
    """Options and text of what is to be typed or written."""
    section = None
    left_out = None
    for found in BLOCK.finditer(page):
        words = dict(word.partition("=")[::2] for word in found.group(2).split())
        section = page[:found.start()].count("\n## ")
        if "root" in words and os.geteuid() != 0:
            left_out = section
        if section != left_out:
            yield words, found.group(3)


def alone(arguments):
    """This program again with processes, mounts and network of its own. Returns if it is that already."""
    if os.environ.get("INDUROP_PAGE_ALONE"):
        return
    user = [] if os.geteuid() == 0 else ["--user", "--map-root-user"]
    command = ["unshare", *user, "--mount", "--net", "--pid", "--fork", "--mount-proc", "--kill-child"]
    if subprocess.run([*command, "true"], capture_output=True, check=False).returncode != 0:
        print("namespaces cannot be made here")
        sys.exit(SKIPPED)
    os.environ["INDUROP_PAGE_ALONE"] = "user" if user else "root"
    os.execvp("unshare", [*command, sys.executable, *arguments])


def mount(what, where, options):
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.mount(what.encode(), where.encode(), b"tmpfs", 0, options.encode()) != 0:
        raise OSError(ctypes.get_errno(), f"mount {where}")


def lay_build(build, place):
    """The build tree, with a copy of the examples: what a page leaves there is gone the next time."""
    place.mkdir()
    for entry in build.iterdir():
        if entry.name != "examples":
            (place / entry.name).symlink_to(entry)
    shutil.copytree(build / "examples", place / "examples", symlinks=True, ignore=shutil.ignore_patterns("CMakeFiles"))


def main():
    alone(sys.argv)
    page, build, folder = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    mount("tmpfs", "/dev/shm", "mode=1777")
    if os.path.isdir("/run/netns"):
        mount("tmpfs", "/run/netns", "mode=755")
    subprocess.run(["ip", "link", "set", "lo", "up"], check=False)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    lay_build(build, folder / "build")
    environment = {**os.environ, "HOME": str(folder), "INDUROP_STATE_DIR": str(folder / "state"),
                   "PATH": f"{build}/bin:{os.environ['PATH']}", "CCACHE_DISABLE": "1"}
    environment.pop("INDUROP_PAGE_ALONE")
    reader = Reader(folder, environment)
    typed = 0
    for options, text in blocks(page.read_text()):
        if "file" in options:
            reader.put(options, text)
        else:
            reader.type(options, text)
        typed += 1
    reader.end()
    print(f"{typed} blocks")
    sys.exit(0 if typed > 0 else 1)


if __name__ == "__main__":
    main()
