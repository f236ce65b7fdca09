# SPDX-License-Identifier: Apache-2.0
"""Days and times of day, by Python's calendar."""

import datetime

from kinds import DAY, MOST_DAYS

FIRST = datetime.date(1970, 1, 1).toordinal()


def date_text(ns):
    return datetime.date.fromordinal(FIRST + ns // DAY).isoformat()


def clock_text(ns):
    ns %= DAY
    seconds, rest = divmod(ns, 10**9)
    text = f"{seconds // 3600:02}:{seconds // 60 % 60:02}:{seconds % 60:02}"
    if rest == 0:
        return text
    if rest % 10**6 == 0:
        return f"{text}.{rest // 10**6:03}"
    return f"{text}.{rest // 10**3:06}" if rest % 10**3 == 0 else f"{text}.{rest:09}"


def duration_text(ns):
    """T#1d2h3m4s5ms6us7ns without what is zero."""
    out, rest = "T#-" if ns < 0 else "T#", abs(ns)
    if rest == 0:
        out += "0s"
    for unit, size in (("d", DAY), ("h", 3600 * 10**9), ("m", 60 * 10**9), ("s", 10**9), ("ms", 10**6), ("us", 10**3), ("ns", 1)):
        if rest >= size:
            out += f"{rest // size}{unit}"
            rest %= size
    return out


def day(days):
    return min(max(days, -MOST_DAYS), MOST_DAYS) * DAY


def day_of_week(ns):
    """0 is Sunday."""
    return (ns // DAY + 4) % 7


def date_of(year, month, day_number):
    """The 31st of April is the 1st of May; months count on into the next years."""
    months = year * 12 + month - 1
    year, month = months // 12, months % 12 + 1
    cycles = (year - 2000) // 400  # the calendar repeats
    first = datetime.date(year - 400 * cycles, month, 1).toordinal() - FIRST + 146097 * cycles
    return day(first + day_number - 1)


def normalized(type_, ns):
    if type_.kind == "date":
        return day(ns // DAY)
    return ns % DAY if type_.kind == "tod" else ns
