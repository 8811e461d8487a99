"""tests/benchmark/peers.toml: what scripts/benchmark --peers reads of other programs, and where it writes what they take."""

import datetime
import json
import tomllib

FIGURES = "# What scripts/benchmark --peers --measure DIR --accept has measured; it writes anew all that follows.\n"

# What a peer, and each table in it, has to have; [kind] is a list of that kind.
PEER = {"name": str, "folder": str, "address": str, "commit": str, "licence": str, "what": str}
SOURCE = {"name": str, "folder": str, "address": str, "commit": str, "licence": str}
FILE = {"name": str, "text": str}
BUILT = {"theirs": str, "ours": str, "packages": [str], "build": [str], "case": [dict]}
CASE = {
    "name": str, "points": int, "threads": [int], "run": [str], "steps": [int],
    "scene": str, "settings": [str], "classical": [str], "frozen": [str],
}  # fmt: skip
MEASUREMENT = {
    "date": datetime.date, "commit": str, "processor": str, "vector_bits": int, "cores": int, "compiler": str,
    "repetitions": int, "load": float,
}  # fmt: skip
WAYS = ["theirs", "classical", "frozen"]
MEASURED = {"peer": str, "case": str, "threads": int} | dict.fromkeys(WAYS, [float])
MAY_BE_EMPTY = {"packages", "settings", "classical", "frozen"}


class BadPeers(Exception):
    """The file lacks something, or a program does not run."""


def fits(value, kind):
    if isinstance(kind, list):
        return isinstance(value, list) and all(fits(one, kind[0]) for one in value)
    return isinstance(value, (int, float) if kind is float else kind)


def expected(kind):
    if isinstance(kind, list):
        return "a list, of which each is " + expected(kind[0])
    return {str: "text", int: "a whole number", float: "a number", dict: "a table"}.get(kind, "a date")


def check(table, fields, owner):
    for field, kind in fields.items():
        if field not in table:
            raise BadPeers(f"{owner} has no '{field}'")
        empty = table[field] in ("", []) and field not in MAY_BE_EMPTY
        if empty or not fits(table[field], kind):
            raise BadPeers(f"'{field}' of {owner}: expected {expected(kind)}, found {table[field]!r}")


def check_peer(peer, owner):
    check(peer, PEER, owner)
    for kind, fields in (("also", SOURCE), ("file", FILE)):
        check({kind: peer.get(kind, [{}])}, {kind: [dict]}, owner)
        for table in peer.get(kind, []):
            check(table, fields, f"a peer.{kind} of {owner}")
    if "not_run" in peer:
        return check(peer, {"not_run": str}, owner)
    check(peer, BUILT, owner)
    for case in peer["case"]:
        of_case = f"a case of {owner}"
        check(case, CASE, of_case)
        check({"counted": "where it does not choose"} | case, {"counted": str}, of_case)
        steps = case["steps"]
        if len(steps) != 2 or not 0 < steps[0] < steps[1]:
            raise BadPeers(f"'steps' of {of_case}: expected two numbers, the second the larger, found {steps}")


def check_row(row, owner):
    check(row, MEASURED, owner)
    for way in WAYS:
        if len(row[way]) != 2 or not 0 < row[way][0] <= row[way][1]:
            raise BadPeers(f"'{way}' of {owner}: expected the least and the most, found {row[way]}")


def read_peers(file):
    """The document; BadPeers if it lacks something."""
    try:
        document = tomllib.loads(file.read_text(encoding="utf-8"))
    except tomllib.TOMLDecodeError as error:
        raise BadPeers(f"{file.name}: {error}") from error
    try:
        check(document, {"peer": [dict]}, "the file")
        for number, peer in enumerate(document["peer"], 1):
            check_peer(peer, peer.get("name", f"peer {number}"))
        if "measurement" in document:
            check(document["measurement"], MEASUREMENT, "the measurement")
        for row in document.get("measured", []):
            check_row(row, "a row of what was measured")
    except BadPeers as error:
        raise BadPeers(f"{file.name}: {error}") from None
    return document


def cases_of(document):
    """[(peer, case, threads)] of all that is run."""
    return [(peer, case, n) for peer in document["peer"] for case in peer.get("case", []) for n in case["threads"]]


def measured_of(document):
    """{(peer, case, threads): row}"""
    return {(row["peer"], row["case"], row["threads"]): row for row in document.get("measured", [])}


def row_of(document, peer, case, threads):
    """What was measured of a case; None of one that has not been."""
    return measured_of(document).get((peer["name"], case["name"], threads))


def toml_of(document):
    """The figures, as they stand at the end of the file."""
    lines = [FIGURES + "[measurement]"]
    for name, value in document["measurement"].items():
        lines.append(
            f"{name} = {json.dumps(value, ensure_ascii=False) if not isinstance(value, datetime.date) else value}"
        )
    for row in document["measured"]:
        lines.append("\n[[measured]]")
        for name, value in row.items():
            note = "  # ns a point and step, the least and the most" if name == WAYS[0] else ""
            lines.append(f"{name} = {json.dumps(value, ensure_ascii=False)}{note}")
    return "\n".join(lines) + "\n"


def write_figures(file, document):
    text = file.read_text(encoding="utf-8").partition(FIGURES)[0].rstrip() + "\n\n" + toml_of(document)
    file.write_text(text, encoding="utf-8")
