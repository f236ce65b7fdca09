#!/usr/bin/env python3
"""Writes ladder programs as PLCopen XML in the manner of an editor that draws on a grid. ladder.py RUNGS [INPUTS] > big.xml"""

import sys
from xml.sax.saxutils import escape

NAMESPACE = "http://www.plcopen.org/xml/tc6_0201"
GRID_X, GRID_Y = 110, 60


class Ladder:
    """One LD body. A rung is drawn from left to right; the methods return what the next element is connected with."""

    def __init__(self):
        self.elements = []
        self.next_id = 3  # 1 and 2 are the rails
        self.top = 60

    def new_id(self):
        self.next_id += 1
        return self.next_id - 1

    @staticmethod
    def connections(sources):
        return "".join(f'<connection refLocalId="{ref}"' + (f' formalParameter="{pin}"' if pin else "") + "/>"
                       for ref, pin in sources)

    def add(self, tag, x, y, attributes, inside):
        ref = self.new_id()
        self.elements.append(f'<{tag} localId="{ref}" height="20" width="30"{attributes}>'
                             f'<position x="{60 + x * GRID_X}" y="{self.top + y * GRID_Y}"/>{inside}</{tag}>')
        return [(ref, "")]

    def switch(self, tag, x, y, variable, sources, attributes=""):
        return self.add(tag, x, y, attributes, f"<connectionPointIn>{self.connections(sources)}</connectionPointIn>"
                                               f"<connectionPointOut/><variable>{escape(variable)}</variable>")

    def contact(self, x, y, variable, sources, attributes=' negated="false"'):
        return self.switch("contact", x, y, variable, sources, attributes)

    def coil(self, x, y, variable, sources, attributes=' negated="false" storage="none"'):
        return self.switch("coil", x, y, variable, sources, attributes)

    def value(self, x, y, expression):
        return self.add("inVariable", x, y, ' negated="false"',
                        f"<connectionPointOut/><expression>{escape(expression)}</expression>")

    def store(self, x, y, expression, sources):
        return self.add("outVariable", x, y, ' negated="false"',
                        f"<connectionPointIn>{self.connections(sources)}</connectionPointIn>"
                        f"<expression>{escape(expression)}</expression>")

    def block(self, x, y, type_name, instance, inputs, outputs):
        pins = "".join(f'<variable formalParameter="{name}"><connectionPointIn>{self.connections(sources)}'
                       "</connectionPointIn></variable>" for name, sources in inputs)
        out = "".join(f'<variable formalParameter="{name}"><connectionPointOut/></variable>' for name in outputs)
        ref = self.add("block", x, y, f' typeName="{type_name}"' + (f' instanceName="{instance}"' if instance else ""),
                       f"<inputVariables>{pins}</inputVariables><inOutVariables/><outputVariables>{out}"
                       "</outputVariables>")
        return {name: [(ref[0][0], name)] for name in outputs}

    def comment(self, text):
        ref = self.new_id()
        self.elements.append(f'<comment localId="{ref}" height="20" width="400"><position x="60" y="{self.top - 25}"/>'
                             f'<content><xhtml:p><![CDATA[{text}]]></xhtml:p></content></comment>')

    def end_rung(self, lines=1):
        self.top += GRID_Y * lines + 60

    def body(self):
        return ('<LD><leftPowerRail localId="1" height="40" width="10"><position x="20" y="40"/>'
                '<connectionPointOut formalParameter=""/></leftPowerRail>'
                '<rightPowerRail localId="2" height="40" width="10"><position x="1200" y="40"/></rightPowerRail>\n'
                + "\n".join(self.elements) + "\n</LD>")


RAIL = [(1, "")]


def variable(name, type_name, address="", initial=""):
    known = type_name in ("BOOL", "INT", "DINT", "TIME", "REAL")
    place = f' address="{address}"' if address else ""
    start = f'<initialValue><simpleValue value="{initial}"/></initialValue>' if initial else ""
    kind = f"<{type_name}/>" if known else f'<derived name="{type_name}"/>'
    return f'<variable name="{name}"{place}><type>{kind}</type>{start}</variable>'


def project(name, variables, body, interval="T#10ms"):
    return f"""<?xml version='1.0' encoding='utf-8'?>
<project xmlns="{NAMESPACE}" xmlns:xhtml="http://www.w3.org/1999/xhtml">
<fileHeader companyName="" productName="{name}" productVersion="1" creationDateTime="2026-01-01T00:00:00"/>
<contentHeader name="{name}"><coordinateInfo><fbd><scaling x="10" y="10"/></fbd><ld><scaling x="10" y="10"/></ld>
<sfc><scaling x="10" y="10"/></sfc></coordinateInfo></contentHeader>
<types><dataTypes/><pous><pou name="{name}" pouType="program"><interface><localVars>
{chr(10).join(variables)}
</localVars></interface><body>{body}</body></pou></pous></types>
<instances><configurations><configuration name="config"><resource name="resource">
<task name="task" priority="1" interval="{interval}"><pouInstance name="instance" typeName="{name}"/></task>
</resource></configuration></configurations></instances>
</project>"""


def many_rungs(count, inputs=64):
    """Every rung: two inputs in series, the coil before in parallel, a negated contact, a coil; every tenth has a timer.
    64 outputs: what the rungs compute is used."""
    ladder = Ladder()
    variables = [variable(f"x{i}", "BOOL", f"%IX{i // 8}.{i % 8}") for i in range(inputs)]
    for i in range(count):
        name = [f"x{(i * k + k) % inputs}" for k in (1, 5, 23)]
        before = f"y{i - 1}" if i > 0 else "x0"
        first = ladder.contact(0, 0, name[0], RAIL)
        series = ladder.contact(1, 0, name[1], first)
        parallel = ladder.contact(0, 1, before, RAIL)
        power = ladder.contact(2, 0, name[2], series + parallel, ' negated="true"')
        if i % 10 == 9:
            variables.append(variable(f"t{i}", "TON"))
            power = ladder.block(3, 0, "TON", f"t{i}", [("IN", power), ("PT", ladder.value(2, 1, "T#50ms"))],
                                 ["Q", "ET"])["Q"]
        output = count - 1 - i
        variables.append(variable(f"y{i}", "BOOL", f"%QX{output // 8}.{output % 8}" if output < 64 else ""))
        ladder.coil(5, 0, f"y{i}", power)
        ladder.end_rung(2)
    return project("many", variables, ladder.body())


if __name__ == "__main__":
    print(many_rungs(*(int(one) for one in sys.argv[1:3])))
