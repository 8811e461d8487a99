#!/usr/bin/python3
"""ranks_test.py ROOT CLAIM PROGRAM: a claim about runs that mpirun starts as several processes."""

import csv
import json
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

from claims import ROOT, call, check_the_claim, claim

STILLPOINT = Path(sys.argv[3]).parent / "stillpoint"
AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_mpi_yield_when_idle": "1"}


def words(count, scene, out, overrides, threads=1):
    launched = ["mpirun", "--oversubscribe", "-n", count] if count > 1 else []
    settings = [word for override in overrides for word in ("--set", override)]
    return [str(word) for word in (*launched, STILLPOINT, "run", ROOT / "problems" / scene, *settings, "--threads", threads, "--out", out)]


def run(count, scene, out, *overrides, threads=1):
    return call(*words(count, scene, out, overrides, threads), env=os.environ | AS_ROOT)


def check_same(folder, scene, *overrides, counts=(2, 3, 4), status=0):
    """A scene leaves the same history and the same figures, however many ranks share it."""
    alone = run(1, scene, folder / "1", *overrides)
    assert alone.returncode == status, alone
    for count in counts:
        out = folder / str(count)
        together = run(count, scene, out, *overrides)
        assert together.returncode == status, together
        assert (out / "history.csv").read_bytes() == (folder / "1/history.csv").read_bytes(), (scene, overrides, count)
        assert figures_of(out) == figures_of(folder / "1") | {"ranks": count}, (scene, overrides, count)
        assert names_in(out) == names_in(folder / "1"), (scene, overrides, count)
    assert list(csv.DictReader((folder / "1/history.csv").open()))


def names_in(folder):
    return sorted(str(file.relative_to(folder)) for file in folder.rglob("*"))


def figures_of(folder):
    summary = json.loads((folder / "summary.json").read_text())
    left_out = ("wall_s", "ns_per_point_step", "set_up_s", "bytes_per_point", "parts", "set_up", "peak_memory_bytes", "threads")
    return {key: value for key, value in summary.items() if key not in left_out}


@claim("a slope that a wall lets go leaves the same history on any number of ranks, though its points change them")
def _(folder):
    check_same(folder, "slope.toml", "stop.time=0.5", "output.every=0.1", "phase.max_motion=0.02", counts=(2, 4))


@claim("bodies of a single phase and in phases, on a line, in the plane, around an axis and in space, do so too")
def _(folder):
    scenes = (
        ("bar.toml", "stop.steps=100"),
        ("cylinder.toml", "stop.steps=100"),
        ("hard/column_in_phases.toml", "stop.steps=200", "phase.quadrature=points"),
        ("ladder/swing_in_phases.toml", "stop.steps=100"),
        ("hard/spinning_cube.toml", "stop.steps=40"),
    )
    for scene, *overrides in scenes:
        name = folder / scene.replace("/", "-")
        name.mkdir()
        check_same(name, scene, *overrides, counts=(3,), status=3)


@claim("rigid bodies press on what ranks share as they do on a body of one process")
def _(folder):
    check_same(folder, "sinking_footing.toml", "stop.steps=150", counts=(2,), status=3)


@claim("a matrix is the same on any number of ranks: critical damping, Newton's method and a consistent mass take it")
def _(folder):
    ways = (("damping.c=critical", "stop.steps=50"), ("solve.method=newton",), ("mass.kind=consistent", "stop.steps=50"))
    for k, overrides in enumerate(ways):
        (folder / str(k)).mkdir()
        check_same(folder / str(k), "cantilever.toml", *overrides, counts=(3,), status=3 if len(overrides) > 1 else 0)


@claim("means over splines, and parts that rest, are the same on any number of ranks, as is Newton's matrix of such means")
def _(folder):
    over_splines = ("phase.dilatation=splines", "grid.basis=quadratic")
    scenes = (
        ("slope.toml", "stop.time=0.2", "output.every=0.05", "phase.max_motion=0.02", *over_splines),
        ("incompressible.toml", "solve.method=newton", *over_splines),
        ("slope.toml", "stop.time=3", "phase.rest=0.01"),
    )
    for k, (scene, *overrides) in enumerate(scenes):
        (folder / str(k)).mkdir()
        check_same(folder / str(k), scene, *overrides, counts=(3,))
    assert json.loads((folder / "2/1/summary.json").read_text())["resting_points"] > 0


@claim("a run that is killed goes on from its checkpoint on any number of ranks, whatever number had left it")
def _(folder):
    scene = ("slope.toml", "stop.time=0.4", "output.every=0.05", "checkpoint.every_steps=20", "phase.max_motion=0.02",
             "phase.dilatation=cells")  # fmt: skip
    assert run(1, scene[0], folder / "whole", *scene[1:]).returncode == 0
    for before, after in ((3, 1), (1, 2)):
        out = folder / f"{before}-{after}"
        launched = subprocess.Popen(words(before, scene[0], out, scene[1:]), env=os.environ | AS_ROOT, stdout=subprocess.DEVNULL,
                                    stderr=subprocess.DEVNULL)  # fmt: skip
        while not (out / "checkpoint-previous.h5").exists():  # it is on its way
            assert launched.poll() is None, (before, after)
            time.sleep(0.01)
        for process in (*call("pgrep", "-P", launched.pid).stdout.split(), launched.pid):
            os.kill(int(process), signal.SIGKILL)
        launched.wait()
        assert not (out / "summary.json").exists(), "it was too quick to be killed"
        launcher = ["mpirun", "--oversubscribe", "-n", str(after)] if after > 1 else []
        resumed = call(*launcher, STILLPOINT, "run", "--resume", out, "--threads", "1", env=os.environ | AS_ROOT)
        assert resumed.returncode == 0, resumed
        assert (out / "history.csv").read_bytes() == (folder / "whole/history.csv").read_bytes(), (before, after)


@claim("bodies that press on each other do so on any number of ranks, as do loads that a displacement drives")
def _(folder):
    for scene, *overrides in (("ladder/stacked_blocks.toml",), ("footing_limit.toml", "stop.steps=100")):
        name = folder / Path(scene).stem
        name.mkdir()
        check_same(name, scene, *overrides, counts=(2,), status=3 if overrides else 0)


@claim("stages go on from one to the next, are resumed, and begin with the points of another run, on any number of ranks")
def _(folder):
    in_time = ("solve.method=relaxation", "damping.strategy=viscous", "stop.residual=1e-6")
    for k, law in enumerate(("linear-elastic", "drucker-prager")):
        name = folder / str(k)
        name.mkdir()
        settings = (f"material.fill.law={law}", *(("material.fill.c=1e6",) if law == "drucker-prager" else ()), *in_time)
        check_same(name, "ladder/lifts.toml", *settings, "checkpoint.every_steps=50", counts=(3,))
        begins = (*settings, "stage=[]", f"initial.from={name / '1/checkpoint.h5'}", "stop.steps=60", "body_force.value=[0,-12]")
        (name / "from").mkdir()
        check_same(name / "from", "ladder/lifts.toml", *begins, counts=(2,), status=3)
    (folder / "plate").mkdir()
    plate = "rigid=[{name='plate', half_plane=[[0, 'H'], [0, -1]], motion=['0', '-0.05*min(max(t - 2, 0), 1)']}]"
    stages = "stage=[{at=1, add=['lift 2', 'lift 3', 'lift 4', 'lift 5', 'lift 6']}, {at=2, add=['plate']}]"
    check_same(folder / "plate", "ladder/lifts.toml", *in_time, plate, stages, "stop.time=4", counts=(2,), status=3)


@claim("what ranks do not share is refused once, by its name, with status 2, and nothing is written")
def _(folder):
    result = run(2, "slope.toml", folder / "out", "phase.quadrature=domains")
    assert result.returncode == 2 and result.stderr.count("domains are not shared among ranks yet") == 1, result
    assert not (folder / "out").exists()


@claim("a scene with a mistake, and a point that leaves the grid, end ranks as they end a single process, in the same words")
def _(folder):
    for scene, override, status in (("bar.toml", "grid.cells=0", 2), ("hard/points_leaving.toml", "phase.quadrature=points", 4)):
        alone, together = run(1, scene, folder / "1", override), run(3, scene, folder / "3", override)
        assert alone.returncode == together.returncode == status, (alone, together)
        said = alone.stderr.strip()
        assert said and together.stderr.count(said) == 1, (alone, together)


@claim("a rank that is killed ends the others within seconds, with a status other than 0")
def _(folder):
    moments = random.Random(1)
    for k in range(2):
        arguments = words(3, "slope.toml", folder / str(k), ("stop.time=1000",))
        launched = subprocess.Popen(arguments, env=os.environ | AS_ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        time.sleep(moments.uniform(1.5, 3))
        found = call("pgrep", "-P", launched.pid).stdout.split()
        assert len(found) == 3, found
        os.kill(int(moments.choice(found)), signal.SIGKILL)
        begun = time.monotonic()
        launched.communicate(timeout=20)
        assert launched.returncode != 0 and time.monotonic() - begun < 5
        assert not (folder / str(k) / "summary.json").exists()


@claim("ranks whose scenes or checkpoints are not the same are refused with status 2, and wait for nobody")
def _(folder):
    def ranks(*others):
        contexts = []
        for k, other in enumerate(others):
            contexts += [":"] if k > 0 else []
            contexts += ["-n", "1", STILLPOINT, "run", *other, "--threads", "1", "--quiet"]
        return call("mpirun", "--oversubscribe", *contexts, env=os.environ | AS_ROOT, timeout=60)

    bar, out = ROOT / "problems/bar.toml", folder / "out"
    for others in (
        ((bar, "--set", "stop.steps=30", "--out", out), (bar, "--set", "stop.steps=20", "--out", out)),
        ((bar, "--out", out), (bar, "--set", "material.bar.E=2e9", "--out", out)),
        ((bar, "--out", out), (ROOT / "problems/column.toml", "--out", out)),
    ):
        result = ranks(*others)
        assert result.returncode == 2, result
        assert result.stderr.count("ranks 0 and 1 have different scenes") == 1, result
        assert not out.exists()


@claim("all ranks hear in Newton's method that the time is over, and end as one process does")
def _(folder):
    begun = time.monotonic()
    result = run(2, "cantilever.toml", folder / "out", "solve.method=newton", "grid.cells=[500,25]", "stop.wall_time=0.5")
    assert result.returncode == 3, result
    assert time.monotonic() - begun < 60
    assert json.loads((folder / "out/summary.json").read_text())["status"] == "time-limit"


@claim("ranks heed in the set-up that the time is over, within seconds and with the status of one process")
def _(folder):
    begun = time.monotonic()
    result = run(2, "cantilever.toml", folder / "out", "damping.c=critical", "grid.cells=[2000,100]", "stop.wall_time=0.2")
    assert result.returncode == 3, result
    assert "in the set-up; the run has not begun" in result.stdout + result.stderr, result
    assert time.monotonic() - begun < 30


check_the_claim()
