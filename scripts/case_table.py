"""What the tables of cases have in common: the stability map's and the accuracy ladder's."""

import itertools
import tomllib


class BadTable(Exception):
    """What is wrong with a table of cases."""


def read_table(file):
    with open(file, "rb") as table:
        return tomllib.load(table)


def as_list(value):
    return value if isinstance(value, list) else [value]


def combinations(vary):
    """(name, settings) of each combination of the values."""
    choices = []
    for keys, values in vary.items():
        names = keys.split("+")
        rows = [as_list(value) if len(names) > 1 else [value] for value in values]
        if any(len(row) != len(names) for row in rows):
            raise BadTable(f"vary.{keys}: expected {len(names)} values in each row")
        choices.append([(" ".join(map(str, row)), [f"{key}={value}" for key, value in zip(names, row)]) for row in rows])
    for combination in itertools.product(*choices):
        yield " ".join(name for name, _ in combination), sum((settings for _, settings in combination), [])
