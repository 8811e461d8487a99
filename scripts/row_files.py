"""Rows of a study, objects of one dataclass, as a CSV file and back. Their fields are texts, and numbers or None."""

import csv
from dataclasses import asdict, fields


def columns_of(kind):
    return [field.name for field in fields(kind)]


def write_rows(file, kind, rows):
    with open(file, "w", newline="", encoding="utf-8") as table:
        writer = csv.DictWriter(table, columns_of(kind), lineterminator="\n")
        writer.writeheader()
        writer.writerows(asdict(row) for row in rows)


def read_rows(file, kind):
    """ValueError or TypeError if the file is not of such rows."""
    numbers = {field.name: int if field.type == int | None else float for field in fields(kind) if field.type is not str}

    def value(column, text):
        if column not in numbers:
            return text
        return numbers[column](text) if text else None

    with open(file, newline="", encoding="utf-8") as table:
        return [kind(**{name: value(name, text) for name, text in line.items()}) for line in csv.DictReader(table)]
