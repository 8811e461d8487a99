#!/usr/bin/python3
"""variants.py SCENE: the scene's variants, for scripts/run.

Prints for each [[variant]]: the name of its folder, its own name, and the "key=value" entries of its `set`, then an
empty string; every string ends with a NUL, so that names and values may hold any character.
"""

import re
import sys
import tomllib


def folder_names(names):
    """'c = pi/10' becomes 'c-pi-10'. A name that leaves nothing, or what another one left, is numbered."""
    taken = set()
    for number, name in enumerate(names, start=1):
        slug = re.sub(r"[^\w.]+", "-", name.lower()).strip("-.")
        if not slug or slug in taken:
            slug = f"{slug or 'variant'}-{number}"
        taken.add(slug)
        yield slug


def main():
    with open(sys.argv[1], "rb") as file:
        variants = tomllib.load(file).get("variant", [])
    names = [variant["name"] for variant in variants]
    for folder, variant in zip(folder_names(names), variants):
        for text in [folder, variant["name"], *variant.get("set", []), ""]:
            sys.stdout.write(f"{text}\0")


if __name__ == "__main__":
    main()
