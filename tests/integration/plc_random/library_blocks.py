# SPDX-License-Identifier: Apache-2.0
"""The function blocks of the standard, as docs/plc_library.md describes them: what the oracle calls, and random calls."""

from kinds import BOOL, DINT, INT, TIME, UNSIGNED

B, T = BOOL, TIME


class Block:
    """inputs: (name, type), outputs: (name, member of the C++ struct, type)."""

    inputs = ()
    outputs = ()
    name = ""

    def __init__(self):
        self.values = {name: False if type_ is B else 0 for name, type_ in self.inputs}
        self.values |= {name: False if type_ is B else 0 for name, type_ in self.outputs}
        self.started = 0
        self.memory = {}

    def rises(self, name):
        before, self.memory[name] = self.memory.get(name, False), self.values[name]
        return self.values[name] and not before

    def call(self, now):
        raise NotImplementedError


class Sr(Block):
    name, inputs, outputs = "SR", (("S1", B), ("R", B)), (("Q1", B),)

    def call(self, now):
        v = self.values
        v["Q1"] = v["S1"] or (v["Q1"] and not v["R"])


class Rs(Block):
    name, inputs, outputs = "RS", (("S", B), ("R1", B)), (("Q1", B),)

    def call(self, now):
        v = self.values
        v["Q1"] = not v["R1"] and (v["S"] or v["Q1"])


class RTrig(Block):
    name, inputs, outputs = "R_TRIG", (("CLK", B),), (("Q", B),)

    def call(self, now):
        self.values["Q"] = self.rises("CLK")


class FTrig(Block):
    name, inputs, outputs = "F_TRIG", (("CLK", B),), (("Q", B),)

    def call(self, now):
        low = not self.values["CLK"]
        self.values["Q"] = low and not self.memory.get("low", False)
        self.memory["low"] = low


class Counter(Block):
    type = INT

    def edges(self):
        return self.rises("CU") if "CU" in self.values else False, self.rises("CD") if "CD" in self.values else False

    def count(self, by):
        self.values["CV"] = min(max(self.values["CV"] + by, self.type.least()), self.type.greatest())


def counters(type_, ending):
    class Ctu(Counter):
        name, type = "CTU" + ending, type_
        inputs, outputs = (("CU", B), ("R", B), ("PV", type_)), (("Q", B), ("CV", type_))

        def call(self, now):
            up, _ = self.edges()
            v = self.values
            if v["R"]:
                v["CV"] = 0
            elif up:
                self.count(1)
            v["Q"] = v["CV"] >= v["PV"]

    class Ctd(Counter):
        name, type = "CTD" + ending, type_
        inputs, outputs = (("CD", B), ("LD", B), ("PV", type_)), (("Q", B), ("CV", type_))

        def call(self, now):
            _, down = self.edges()
            v = self.values
            if v["LD"]:
                v["CV"] = v["PV"]
            elif down:
                self.count(-1)
            v["Q"] = v["CV"] <= 0

    class Ctud(Counter):
        name, type = "CTUD" + ending, type_
        inputs = (("CU", B), ("CD", B), ("R", B), ("LD", B), ("PV", type_))
        outputs = (("QU", B), ("QD", B), ("CV", type_))

        def call(self, now):
            up, down = self.edges()
            v = self.values
            if v["R"]:
                v["CV"] = 0
            elif v["LD"]:
                v["CV"] = v["PV"]
            elif up != down:
                self.count(1 if up else -1)
            v["QU"], v["QD"] = v["CV"] >= v["PV"], v["CV"] <= 0

    return [Ctu, Ctd, Ctud]


class Tp(Block):
    name, inputs, outputs = "TP", (("IN", B), ("PT", T)), (("Q", B), ("ET", T))

    def call(self, now):
        v = self.values
        if self.rises("IN") and not v["Q"]:
            self.started, v["Q"] = now, True
        if v["Q"]:
            length = max(v["PT"], 0)
            v["ET"] = min(now - self.started, length)
            v["Q"] = now - self.started < length
        if not v["Q"] and not v["IN"]:
            v["ET"] = 0


class Ton(Block):
    name, inputs, outputs = "TON", (("IN", B), ("PT", T)), (("Q", B), ("ET", T))

    def call(self, now):
        v = self.values
        if self.rises("IN"):
            self.started = now
        if not v["IN"]:
            v["Q"], v["ET"] = False, 0
        elif not v["Q"]:
            v["ET"] = min(now - self.started, max(v["PT"], 0))
            v["Q"] = v["ET"] >= max(v["PT"], 0)


class Tof(Block):
    name, inputs, outputs = "TOF", (("IN", B), ("PT", T)), (("Q", B), ("ET", T))

    def call(self, now):
        v = self.values
        before, self.memory["IN"] = self.memory.get("IN", False), v["IN"]
        if v["IN"]:
            v["Q"], v["ET"] = True, 0
            return
        if before:
            self.started = now
        if v["Q"]:
            v["ET"] = min(now - self.started, max(v["PT"], 0))
            v["Q"] = now - self.started < max(v["PT"], 0)


ALL = [Sr, Rs, RTrig, FTrig, Tp, Ton, Tof, *counters(INT, ""), *counters(DINT, "_DINT"), *counters(UNSIGNED[1], "_UINT")]
