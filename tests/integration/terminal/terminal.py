# SPDX-License-Identifier: Apache-2.0
"""A terminal for tests: a pseudo terminal with a screen of letters, as much of an xterm as programs with ncurses use."""

import fcntl
import os
import pty
import re
import select
import struct
import termios
import time

DEADLINE_S = 30
SEQUENCE = re.compile(r"\x1b\[([?>]?)([\d;]*)([A-Za-z@`])|\x1b[()][A-Z0-9]|\x1b[=>78MDE]|\x1b\][^\x07]*\x07")


class Terminal:
    def __init__(self, command, environment, rows=24, columns=80):
        self.rows, self.columns = rows, columns
        self.clear()
        self.pid, self.file = pty.fork()
        if self.pid == 0:
            os.execvpe(command[0], command, dict(environment, TERM="xterm", LC_ALL="C.UTF-8", LINES="", COLUMNS=""))
        self.resize(rows, columns)
        self.rest = ""

    def clear(self):
        self.screen = [[" "] * self.columns for _ in range(self.rows)]
        self.row = self.column = 0

    def resize(self, rows, columns):
        self.rows, self.columns = rows, columns
        self.clear()
        fcntl.ioctl(self.file, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))

    def lines(self):
        return ["".join(row).rstrip() for row in self.screen]

    def press(self, keys):
        os.write(self.file, keys.encode())

    def echoes(self):
        return bool(termios.tcgetattr(self.file)[3] & termios.ECHO)

    def read(self, seconds=0.1):
        """Takes what has come; False once the program has closed its end."""
        if not select.select([self.file], [], [], seconds)[0]:
            return True
        try:
            data = os.read(self.file, 65536)
        except OSError:
            return False
        self.show(self.rest + data.decode("utf-8", "replace"))
        return bool(data)

    def sees(self, condition, what):
        end = time.monotonic() + DEADLINE_S
        while time.monotonic() < end:
            self.read()
            if condition(self.lines()):
                return
        raise AssertionError(f"waited in vain for {what}:\n" + "\n".join(self.lines()))

    def wait(self):
        """The exit code, once the program has ended."""
        while self.read(DEADLINE_S):
            pass
        return os.waitstatus_to_exitcode(os.waitpid(self.pid, 0)[1])

    def show(self, text):
        at = 0
        self.rest = ""
        while at < len(text):
            if text[at] == "\x1b":
                found = SEQUENCE.match(text, at)
                if not found:
                    self.rest = text[at:]
                    assert len(self.rest) < 100, f"unknown sequence {self.rest!r}"
                    return
                if found.group(3):
                    self.obey(found.group(1), [int(word or 0) for word in found.group(2).split(";")], found.group(3))
                at = found.end()
                continue
            self.put(text[at])
            at += 1

    def put(self, letter):
        if letter == "\r":
            self.column = 0
        elif letter == "\n":
            assert self.row + 1 < self.rows, "the screen has scrolled"
            self.row += 1
        elif letter == "\b":
            self.column -= 1
        elif letter >= " ":
            if self.column < self.columns:
                self.screen[self.row][self.column] = letter
                self.last = letter
            self.column += 1

    def obey(self, mark, numbers, what):
        if mark:
            return
        first = max(numbers[0], 1)
        if what == "H":
            self.row, self.column = first - 1, max(numbers[1], 1) - 1 if len(numbers) > 1 else 0
        elif what == "d":
            self.row = first - 1
        elif what in "G`":
            self.column = first - 1
        elif what in "ABCD":
            self.row += {"A": -first, "B": first}.get(what, 0)
            self.column += {"C": first, "D": -first}.get(what, 0)
        elif what == "J":
            self.erase(self.row, self.column if numbers[0] == 0 else 0)
        elif what == "K":
            ends = {0: (self.column, self.columns), 1: (0, self.column + 1), 2: (0, self.columns)}[numbers[0]]
            self.screen[self.row][ends[0]:ends[1]] = [" "] * (ends[1] - ends[0])
        elif what == "X":
            for i in range(self.column, min(self.column + first, self.columns)):
                self.screen[self.row][i] = " "
        elif what == "b":
            for _ in range(first):
                self.put(self.last)
        elif what == "P":
            line = self.screen[self.row]
            del line[self.column:self.column + first]
            line.extend([" "] * (self.columns - len(line)))
        elif what == "@":
            line = self.screen[self.row]
            line[self.column:self.column] = [" "] * first
            del line[self.columns:]
        else:
            assert what in "mrlhtc", f"unknown sequence [{numbers}{what}"

    def erase(self, row, column):
        self.screen[row][column:] = [" "] * (self.columns - column)
        for below in range(row + 1, self.rows):
            self.screen[below] = [" "] * self.columns
