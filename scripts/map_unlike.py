"""Random scenes unlike those of the stability map: contact, gaps, axes, ground, driven and staged loads, small numbers.

Scene k of a seed and of some families is always the same, whatever the number of scenes. A scene is judged by an answer
that is known, or by Newton's method where it has one, and else by uniqueness: every way to rest has to find the same
equilibrium.
"""

import csv
import random
import shlex
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from fnmatch import fnmatchcase

from case_table import BadTable
from unlike_bodies import BODIES
from unlike_contact import ON_WALLS
from unlike_gaps import ACROSS_GAPS
from unlike_ground import OF_GROUND
from unlike_judge import verdicts

FAMILIES = [*ON_WALLS, *ACROSS_GAPS, *OF_GROUND, *BODIES]
COLUMNS = ["family", "scene", "title", "way", "outcome", "reason"]
OUTCOMES = ["right", "noted", "refused", "honest", "alarm", "unnamed", "FALSE", "hang", "crash"]


def draw(seed, k, families, all_ways=False):
    """(family, scene k of the seed)"""
    r = random.Random(f"unlike {seed} {k}")
    family = r.choice(families)
    unlike = family(r, all_ways)
    unlike.scene["title"] = f"Unlike scene {k} of seed {seed}: {unlike.scene['title']}"
    return family.__name__, unlike


def names():
    return list(dict.fromkeys(family.__name__ for family in FAMILIES))


def families_of(pattern):
    return [family for family in FAMILIES if fnmatchcase(family.__name__, pattern)]


def tell(family, k, unlike, found, known):
    """What is wrong with a scene, or known to be; True if it is wrong and not known."""
    faults = [each for each in found if each.wrong]
    if not faults and not known:
        return False
    print(f"{family} {k}: {unlike.scene['title']}{f'  known: {known}' if known else ''}")
    for each in faults:
        print(f"  {each.outcome}: {each.reason}\n    {shlex.join(each.command)}")
    if known and not faults:
        print("  WRONG: the fault is gone: its mark in map.toml has to go")
    return bool(faults) != bool(known)


def write(file, lines):
    with open(file, "w", newline="", encoding="utf-8") as table:
        csv.writer(table, lineterminator="\n").writerows([COLUMNS, *lines])


def print_counts(scenes, counts):
    print(f"{'':<24}{'scenes':>8}" + "".join(f"{outcome:>9}" for outcome in OUTCOMES))
    for family, outcomes in sorted(counts.items()):
        print(f"{family:<24}{scenes[family]:>8}" + "".join(f"{outcomes[outcome] or '':>9}" for outcome in OUTCOMES))


def run_unlike(options, count, known):
    """The number of scenes with a way that is wrong. Their files stay in options.scenes. known: {number: its fault}"""
    options.scenes.mkdir(parents=True, exist_ok=True)
    families = families_of(options.family)
    if not families:
        raise BadTable(f"--family: no family matches {options.family}; expected one of {', '.join(names())}")

    def one(k):
        family, unlike = draw(options.seed, k, families, options.all_ways)
        return family, unlike, *verdicts(options.program, unlike, options.scenes, f"unlike-{options.seed}-{k}")

    counts, scenes, wrong, lines, unanswered = {}, Counter(), 0, [], 0
    with ThreadPoolExecutor(options.jobs) as pool:
        for k, (family, unlike, found, missing) in enumerate(pool.map(one, range(count))):
            scenes[family] += 1
            counts.setdefault(family, Counter()).update(each.outcome for each in found)
            lines += [[family, k, unlike.scene["title"], each.way, each.outcome, each.reason] for each in found]
            wrong += tell(family, k, unlike, found, known.get(k, ""))
            unanswered += bool(missing)
            if missing:
                print(f"{family} {k}: {missing}")
    write(options.out / "unlike.csv", lines)
    print_counts(scenes, counts)
    print(f"{count} unlike scenes of seed {options.seed}: {wrong} wrong, {unanswered} without an answer to judge by")
    return wrong
