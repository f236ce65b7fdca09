#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""expressions_test.py PROGRAM [COUNT]: random expressions of jobs, evaluated by PROGRAM and by the tree they were made
of. They are written with as few brackets as the precedence of the language allows, so that it is judged, too."""

import math
import random
import subprocess
import sys

VARIABLES = {"n": 7.0, "half": 0.5, "I4": 5.0}
ARRAY = [2.0, -3.0, 0.0, 10.0]


def rounded(x):
    whole = math.floor(abs(x))
    return math.copysign(whole + (abs(x) - whole >= 0.5), x)


def from_degrees(x):
    return x * math.pi / 180


def in_degrees(x):
    return x * 180 / math.pi


FUNCTIONS = {
    "ABS": abs, "SQRT": math.sqrt, "SIN": lambda x: math.sin(from_degrees(x)),
    "COS": lambda x: math.cos(from_degrees(x)), "TAN": lambda x: math.tan(from_degrees(x)),
    "ASIN": lambda x: in_degrees(math.asin(x)), "ACOS": lambda x: in_degrees(math.acos(x)),
    "ATAN": lambda x: in_degrees(math.atan(x)), "ROUND": rounded, "TRUNC": math.trunc,
    "ATAN2": lambda y, x: in_degrees(math.atan2(y, x)), "MIN": min, "MAX": max}
TWO = {"ATAN2", "MIN", "MAX"}
# Precedence and meaning; a comparison takes sums only, so one in another has brackets.
OPERATORS = {
    "OR": (1, lambda a, b: a != 0 or b != 0), "AND": (2, lambda a, b: a != 0 and b != 0),
    "=": (4, lambda a, b: a == b), "<>": (4, lambda a, b: a != b), "<": (4, lambda a, b: a < b),
    "<=": (4, lambda a, b: a <= b), ">": (4, lambda a, b: a > b), ">=": (4, lambda a, b: a >= b),
    "+": (5, lambda a, b: a + b), "-": (5, lambda a, b: a - b),
    "*": (6, lambda a, b: a * b), "/": (6, lambda a, b: a / b), "MOD": (6, math.fmod)}
NOT, SIGN, OPERAND = 3, 7, 8


class NoValue(Exception):
    pass


def value_of(function, *values):
    try:
        value = float(function(*values))
    except (ValueError, ZeroDivisionError, OverflowError) as wrong:
        raise NoValue from wrong
    if not math.isfinite(value):
        raise NoValue
    return value


def made(pick, depth):
    """A text, its precedence and a function that gives its value."""
    kind = pick.random() if depth > 0 else 0
    if kind < 0.3:
        which = pick.randrange(4)
        if which == 0:
            number = pick.choice(["0", "1", "2.5", "30", "90", "1e-3", "0.3", "12.75"])
            return number, OPERAND, lambda: float(number)
        if which == 1 and depth > 0:
            text, precedence, inner = made(pick, depth - 1)

            def element():
                index = inner()
                if index not in (0, 1, 2, 3):
                    raise NoValue
                return ARRAY[int(index)]
            return f"a[{bracketed(text, precedence, 5)}]", OPERAND, element
        if which == 2:
            index = pick.randrange(4)
            return f"a[{index}]", OPERAND, lambda: ARRAY[index]
        name = pick.choice(list(VARIABLES))
        return name, OPERAND, lambda: VARIABLES[name]
    if kind < 0.5:
        name = pick.choice(list(FUNCTIONS))
        parts = [made(pick, depth - 1) for _ in range(2 if name in TWO else 1)]
        text = ", ".join(part[0] for part in parts)
        return f"{name}({text})", OPERAND, lambda: value_of(FUNCTIONS[name], *[part[2]() for part in parts])
    if kind < 0.55:
        text, precedence, inner = made(pick, depth - 1)
        return "NOT " + bracketed(text, precedence, NOT), NOT, lambda: float(inner() == 0)
    if kind < 0.6:
        text, precedence, inner = made(pick, depth - 1)
        return "- " + bracketed(text, precedence, SIGN), SIGN, lambda: -inner()
    sign = pick.choice(list(OPERATORS))
    precedence, function = OPERATORS[sign]
    left, right = made(pick, depth - 1), made(pick, depth - 1)
    compares = precedence == 4
    text = (bracketed(left[0], left[1], precedence + compares) + f" {sign} " +
            bracketed(right[0], right[1], precedence + 1))

    def both():
        first = left[2]()
        return value_of(function, first, right[2]())
    return text, precedence, both


def bracketed(text, precedence, needed):
    return f"({text})" if precedence < needed else text


def main():
    program, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 3000
    pick = random.Random(42)
    asked = [made(pick, 4) for _ in range(count)]
    run = subprocess.run([program], input="\n".join(one[0] for one in asked), capture_output=True, text=True, check=True)
    answers = run.stdout.splitlines()
    if len(answers) != count:
        sys.exit(f"{count} expressions, {len(answers)} answers")
    wrong = without = refused = 0
    for (text, _, evaluate), answer in zip(asked, answers):
        if "too long" in answer or "brackets inside" in answer:
            refused += 1
            continue
        answer = "none" if "the last element" in answer else answer  # found by the parser already
        try:
            wanted = evaluate()
            same = answer != "none" and ":" not in answer and math.isclose(float(answer), wanted, rel_tol=1e-12, abs_tol=1e-12)
        except NoValue:
            wanted, same = "none", answer == "none"
            without += 1
        if not same:
            wrong += 1
            print(f"{text}\n  a job: {answer}\n  here: {wanted}")
    print(f"{count} expressions, {without} without a value, {refused} too long, {wrong} differ")
    return 1 if wrong or refused > count / 10 or not 0 < without < count / 2 else 0


if __name__ == "__main__":
    sys.exit(main())
