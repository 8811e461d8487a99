"""Runs the program under a limit of processor time, and reads what it left."""

import json
import math
import re
import signal
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np


@dataclass
class Run:
    """What a call of `stillpoint run` left."""

    exit_status: int | None  # None: it was cut off
    summary: dict
    message: str
    first: dict  # fields of all points in the first frame and the last
    last: dict

    def says(self, pattern):
        texts = [self.message, self.summary.get("reason") or "", *self.summary.get("notes", [])]
        return any(re.search(pattern, text) for text in texts)


def frames(file):
    if not file.exists():
        return {}, {}
    with h5py.File(file) as fields:
        names = sorted(name for name in fields if name.startswith("frame_"))
        taken = [{name: fields[frame][name][()] for name in fields[frame]} for frame in names[:1] + names[-1:]]
    for frame in taken:
        for vector in ("u", "v"):
            if frame[vector].ndim == 1:  # of a line
                frame[vector] = np.pad(frame[vector][:, None], ((0, 0), (0, 2)))
    return (taken[0], taken[-1]) if taken else ({}, {})


def limited(command, folder, seconds, threads=1):
    """The ended process, or None if it was cut off. seconds: of the processor, whatever else the machine does."""
    limit = ["prlimit", f"--cpu={math.ceil(seconds)}"]
    whole = [*limit, *command, "--out", folder, "--threads", str(threads), "--quiet"]
    try:
        ended = subprocess.run(whole, capture_output=True, text=True, timeout=10 * seconds, check=False)
    except subprocess.TimeoutExpired:
        return None
    return None if ended.returncode in (-signal.SIGXCPU, -signal.SIGKILL) else ended


def run_in(folder, command, seconds, threads=1):
    """Runs in a folder that stays."""
    ended = limited(command, folder, seconds, threads)
    if ended is None:
        return Run(None, {}, f"no end within {seconds:g} s", {}, {})
    summary, file = {}, Path(folder) / "summary.json"
    if file.exists():
        summary = json.loads(file.read_text(encoding="utf-8"))
    return Run(ended.returncode, summary, ended.stderr.strip(), *frames(Path(folder) / "fields.h5"))


def run(command, seconds, threads=1):
    """Runs in a folder of its own, which does not stay."""
    with tempfile.TemporaryDirectory(prefix="stillpoint-") as folder:
        return run_in(folder, command, seconds, threads)


def difference(u, answer):
    """‖u − answer‖/‖answer‖ over the points; where the answer is 0, ‖u‖."""
    if np.shape(u) != np.shape(answer):
        return math.inf
    scale = np.linalg.norm(answer)
    return float(np.linalg.norm(u - answer) / (scale if scale > 0 else 1))
