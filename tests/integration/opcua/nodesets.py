# SPDX-License-Identifier: Apache-2.0
"""What the NodeSet files of the OPC Foundation demand of an instance of a type: its mandatory nodes, with their types. Names and
ids are pairs with the URI of their namespace."""

import pathlib
import re
import xml.etree.ElementTree as ElementTree

UA = "http://opcfoundation.org/UA/"
FILES = ("Opc.Ua.NodeSet2.xml", "Opc.Ua.Di.NodeSet2.xml", "Opc.Ua.IA.NodeSet2.xml", "Opc.Ua.Robotics.NodeSet2.xml")
TAG = "{http://opcfoundation.org/UA/2011/03/UANodeSet.xsd}"
SUBTYPE, TYPE, RULE, HIERARCHY = (UA, "i=45"), (UA, "i=40"), (UA, "i=37"), (UA, "i=33")
MANDATORY, PLACEHOLDER = (UA, "i=78"), (UA, "i=11510")


class Declared:
    """A node of a NodeSet file."""

    def __init__(self, element, read_id, uris):
        self.kind = element.tag[len(TAG) + len("UA"):]  # Object, Variable, ...
        number, text = re.match(r"(?:(\d+):)?(.*)", element.get("BrowseName")).groups()
        self.name = (uris[int(number or 0)], text)
        self.data_type = read_id(element.get("DataType", "i=24")) if self.kind == "Variable" else None
        self.rank = int(element.get("ValueRank", -1))
        self.forward, self.backward = [], []
        self.fields = {int(field.get("Value")): field.get("Name") for field in element.iterfind(f"{TAG}Definition/{TAG}Field")
                       if field.get("Value")}


class NodeSets:
    def __init__(self, folder, *others):
        """others: further files, each after those that it refers to."""
        self.nodes = {}
        references = []
        for file in (*FILES, *others):
            root = ElementTree.parse(pathlib.Path(folder) / file).getroot()
            uris = [UA] + [one.text for one in root.iterfind(f"{TAG}NamespaceUris/{TAG}Uri")]
            aliases = {one.get("Alias"): one.text for one in root.iterfind(f"{TAG}Aliases/{TAG}Alias")}

            def read_id(text, uris=uris, aliases=aliases):
                text = aliases.get(text, text)
                space, _, rest = text.rpartition(";")
                return uris[int(space[len("ns="):] or 0)], rest

            for element in root:
                if "NodeId" not in element.attrib:
                    continue
                own = read_id(element.get("NodeId"))
                self.nodes[own] = Declared(element, read_id, uris)
                for one in element.iterfind(f"{TAG}References/{TAG}Reference"):
                    ends = (own, read_id(one.text))
                    references.append((read_id(one.get("ReferenceType")), *(ends if one.get("IsForward") != "false" else ends[::-1])))
        for kind, source, target in set(references):
            if source in self.nodes and target in self.nodes:
                self.nodes[source].forward.append((kind, target))
                self.nodes[target].backward.append((kind, source))

    def first(self, node, kind):
        return next((target for one, target in self.nodes[node].forward if one == kind), None)

    def with_supertypes(self, node):
        """A type and all that it is a subtype of, the nearest first."""
        while node:
            yield node
            node = next((source for kind, source in self.nodes[node].backward if kind == SUBTYPE), None)

    def is_a(self, node, wanted):
        return wanted in self.with_supertypes(node)

    def named(self, uri, name):
        return next(one for one, node in self.nodes.items() if node.name == (uri, name) and node.kind.endswith("Type"))

    def members(self, node):
        """What is declared directly below a node or a type: name -> (id, modelling rule)."""
        found = {}
        for kind, target in self.nodes[node].forward:
            if self.is_a(kind, HIERARCHY) and kind != SUBTYPE and (rule := self.first(target, RULE)):
                found[self.nodes[target].name] = (target, rule)
        return found

    def demanded(self, type_id, declaration=None):
        """Members of an instance of this type, which is declared so: those of the declaration, of the type, of its supertypes."""
        found = {}
        for one in ([declaration] if declaration else []) + list(self.with_supertypes(type_id)):
            for name, member in self.members(one).items():
                before = found.get(name)
                if before is None or (member[1] == MANDATORY and before[1] != MANDATORY):
                    found[name] = member
        return found
