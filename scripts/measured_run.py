#!/usr/bin/python3
"""measured_run.py FILE COMMAND…: runs a command, writes its time and its peak memory to FILE, and ends as it did.

FILE is an object of `seconds`, on the wall, `processor_seconds` and `megabytes`. A small program of its own, because Linux
counts what the process that starts a command holds at that moment to the command's peak: with NumPy in it that is twice
what a small run takes.
"""

import json
import os
import sys
import time


def measured(command):
    """(exit status as subprocess has it, {figure: value})"""
    start = time.monotonic()
    _, status, usage = os.wait4(os.posix_spawnp(command[0], command, os.environ), 0)
    figures = {"seconds": time.monotonic() - start, "processor_seconds": usage.ru_utime + usage.ru_stime}
    return os.waitstatus_to_exitcode(status), figures | {"megabytes": 1.024e-3 * usage.ru_maxrss}  # [KiB]


def main():
    file, *command = sys.argv[1:]
    try:
        status, figures = measured(command)
    except OSError as error:
        print(f"measured_run: {error}", file=sys.stderr)
        return 2
    with open(file, "w", encoding="utf-8") as usage:
        json.dump(figures, usage)
    if status < 0:  # by a signal, as which a limit of time shows
        os.kill(os.getpid(), -status)
    return status


if __name__ == "__main__":
    sys.exit(main())
