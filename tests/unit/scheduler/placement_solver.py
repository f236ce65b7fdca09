#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Is what place() finds as good as it can be: the same random schedules given to an exact solver (z3).

Usage: placement_solver.py PLACEMENT_SETS FIRST_SEED COUNT. Exit code 77 without python3-z3.
"""
import json
import subprocess
import sys

try:
    import z3
except ImportError:
    print("skipped: no python3-z3")
    sys.exit(77)

BASIC = 1000


def own_ends(found):
    """Longest response of each module as placed, and the longest a core is busy, by going through the ticks."""
    modules = found["modules"]
    worst = [0] * len(modules)
    busiest = 0
    for tick in range(4):
        free = [0] * found["cores"]
        end = [0] * len(modules)
        for i in found["order"]:
            period, execution, _, shares = modules[i]
            if (tick - found["shift"][i]) % period:
                continue
            core = found["core"][i]
            begin = max([free[core]] + [end[k] for k in shares if found["core"][k] != core])
            end[i] = free[core] = begin + execution
            worst[i] = max(worst[i], end[i])
        busiest = max([busiest] + free)
    return worst, busiest


def check_valid(found):
    modules = found["modules"]
    worst, busiest = own_ends(found)
    assert found["holds"] == all(w <= m[2] for w, m in zip(worst, modules)), f"{found}: holds or not: {worst}"
    assert not found["holds"] or busiest == found["busiest"], f"{found}: busy for {busiest}"
    place = {module: n for n, module in enumerate(found["order"])}
    assert sorted(place) == list(range(len(modules)))
    for i, module in enumerate(modules):
        for k in module[3]:
            assert place[k] < place[i], f"{found}: {i} before {k}"
            if not found["split"]:
                assert found["core"][k] == found["core"][i] and found["shift"][k] == found["shift"][i], f"{found}: apart"


def units_of(modules):
    unit = list(range(len(modules)))
    for i, module in enumerate(modules):
        for k in module[3]:
            old, new = unit[i], unit[k]
            unit = [new if u == old else u for u in unit]
    return unit


def together(found, shifts):
    """Solver in which what shares data is on one core, and its longest busy time."""
    modules, cores = found["modules"], found["cores"]
    n = len(modules)
    unit = units_of(modules)
    solver = z3.Optimize()
    core = [z3.Int(f"core{u}") for u in range(n)]
    shift = [z3.Int(f"shift{u}") for u in range(n)]
    for u in set(unit):
        shortest = min(m[0] for m, v in zip(modules, unit) if v == u)
        solver.add(core[u] >= 0, core[u] < cores, shift[u] >= 0, shift[u] < (shortest if shifts else 1))
    rank = [z3.Int(f"rank{i}") for i in range(n)]
    solver.add(z3.Distinct(rank) if n > 1 else True)
    for i in range(n):
        solver.add(rank[i] >= 0, rank[i] < n)
        for k in modules[i][3]:
            solver.add(rank[k] < rank[i])

    def due(i, tick):
        period = modules[i][0]
        return z3.Or([shift[unit[i]] == s for s in range(4) if (tick - s) % period == 0])

    busiest = z3.Int("busiest")
    for tick in range(max(m[0] for m in modules)):
        for j in range(n):
            before = [z3.If(z3.And(core[unit[i]] == core[unit[j]], rank[i] < rank[j], due(i, tick)), modules[i][1], 0)
                      for i in range(n) if i != j]
            solver.add(z3.Implies(due(j, tick), z3.Sum(before + [modules[j][1]]) <= modules[j][2]))
        for c in range(cores):
            solver.add(busiest >= z3.Sum([z3.If(z3.And(core[unit[i]] == c, due(i, tick)), modules[i][1], 0)
                                          for i in range(n)]))
    return solver, busiest


def split(found):
    """Any module on any core, one at a time on each, what shares data one after the other."""
    modules, cores = found["modules"], found["cores"]
    n = len(modules)
    solver = z3.Optimize()
    core = [z3.Int(f"core{i}") for i in range(n)]
    start = [z3.Int(f"start{i}") for i in range(n)]
    busiest = z3.Int("busiest")
    for i, (_, execution, deadline, shares) in enumerate(modules):
        solver.add(core[i] >= 0, core[i] < cores, start[i] >= 0, start[i] + execution <= deadline)
        solver.add(busiest >= start[i] + execution)
        for k in shares:
            solver.add(start[i] >= start[k] + modules[k][1])
        for k in range(i):
            solver.add(z3.Or(core[i] != core[k], start[i] >= start[k] + modules[k][1],
                             start[k] >= start[i] + execution))
    return solver, busiest


def optimum(solver, busiest):
    """Least busy time; None: no placement holds."""
    solver.minimize(busiest)
    if solver.check() != z3.sat:
        return None
    return solver.model()[busiest].as_long()


def main():
    sets = subprocess.run(sys.argv[1:4], check=True, capture_output=True, text=True).stdout.splitlines()
    wrong, ratios, possible = [], [], 0
    for line in sets:
        found = json.loads(line)
        check_valid(found)
        best = optimum(*(split(found) if found["split"] else together(found, False)))
        feasible = best is not None or (not found["split"] and optimum(*together(found, True)) is not None)
        possible += feasible
        if feasible != found["holds"]:
            wrong.append(f"{line}: the solver says {'yes' if feasible else 'no'}")
        elif best is not None:
            ratios.append((found["busiest"] / best, found["seed"]))
            if ratios[-1][0] > 1.05:
                wrong.append(f"{line}: {found['busiest']} us, the best is {best} us")
    ratios.sort()
    print(f"{len(sets)} schedules, {possible} can hold, {len(wrong)} findings; busy for {ratios[-1][0]:.4f} of the least "
          f"at most, {sum(r for r, _ in ratios) / len(ratios):.4f} on average")
    for finding in wrong[:20]:
        print(finding)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
