#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A PLC program with all kinds of addresses that random programs lack: interfaces, THIS, derived blocks, VAR_INST, arrays and
structures of pointers, pointers to blocks, VAR_IN_OUT in methods. Before each scan what it keeps goes to another process, and
the scans from there on are those of a process that runs all of them."""

import argparse
import os
import sys
import tempfile
import types

from driver import Failed, checked_call, compile_driver, results, resumed
from program import TIMES

TEXT = """
INTERFACE IStore
  METHOD Put : INT VAR_INPUT what : INT; END_VAR END_METHOD
END_INTERFACE
TYPE Link : STRUCT target : POINTER TO INT; count : INT; END_STRUCT; END_TYPE
FUNCTION_BLOCK Store IMPLEMENTS IStore
VAR sum : INT; END_VAR
VAR_OUTPUT own : POINTER TO Store; END_VAR
METHOD PUBLIC Put : INT
VAR_INPUT what : INT; END_VAR
VAR_INST puts : INT; END_VAR
  puts := puts + 1;
  sum := sum + what;
  own := ADR(THIS^);
  Put := 100 * puts + sum;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Doubling EXTENDS Store
VAR_INPUT factor : INT := 2; END_VAR
METHOD PUBLIC Put : INT
VAR_INPUT what : INT; END_VAR
VAR_INST puts : INT; END_VAR
  puts := puts + 3;
  Put := SUPER^.Put(factor * what) + puts;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Follower
VAR_IN_OUT place : INT; END_VAR
VAR inner : ARRAY[0..1] OF TON; END_VAR
METHOD PUBLIC Bump : INT
  place := place + 1;
  Bump := place;
END_METHOD
END_FUNCTION_BLOCK
PROGRAM P0
VAR
  first : Store;
  second : Doubling;
  rows : ARRAY[1..2] OF Doubling;
  follower : Follower;
  chosen : IStore;
  links : ARRAY[0..2] OF Link;
  of_any : ARRAY[0..1] OF IStore;
  numbers : ARRAY[0..3] OF INT := [1, 2, 3, 4];
  alias : REFERENCE TO INT;
  into : POINTER TO INT;
  scan : INT;
  a, b, c, d, e : INT;
END_VAR
  IF scan = 0 THEN
    chosen := second;
    of_any[0] := first;
    of_any[1] := rows[2];
    links[1].target := ADR(numbers[2]);
    links[2].target := ADR(links[1].count);
    alias REF= numbers[3];
    into := ADR(rows[1].factor);
    follower(place := numbers[1]);
  END_IF;
  scan := scan + 1;
  a := chosen.Put(scan);
  b := of_any[scan MOD 2].Put(1);
  links[1].target^ := links[1].target^ + scan;
  links[2].target^ := links[2].target^ + 2;
  alias := alias + 5;
  into^ := into^ + 1;
  c := follower.Bump() + numbers[2] + numbers[3] + links[1].count;
  d := rows[1].Put(1) + into^;
  IF second.own <> NULL THEN
    e := second.own^.Put(0);
  END_IF;
  IF scan = 3 THEN
    chosen := of_any[1];
    alias REF= numbers[0];
  END_IF;
END_PROGRAM
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", required=True)
    build = os.path.abspath(parser.parse_args().build)
    program = types.SimpleNamespace(prefix="P0", types=[], blocks_used=[],
                                    variables=[types.SimpleNamespace(name=name, type=None) for name in "abcde"])
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "batch.st"), "w", encoding="latin-1") as file:
            file.write(TEXT)
        checked_call([os.path.join(build, "bin/indurop"), "plc", "build", "batch.st", "--dialect", "codesys", "--only-sources", "--quiet"], folder)
        path = compile_driver(build, folder, [program], "-O0")
        expected = results(path, folder)["P0"]
        assert len(expected) == len(TIMES) and all(fault == "" for fault, _ in expected), expected
        for scan in range(1, len(TIMES)):
            found = resumed(path, folder, scan)["P0"]
            if found != expected:
                raise Failed(f"continued before scan {scan}: {found}, expected {expected}")
    print(f"{len(TIMES) - 1} continuations: equal")
    return 0


if __name__ == "__main__":
    sys.exit(main())
