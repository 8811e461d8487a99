"""Unlike scenes with a gap: bodies above a wall or a held face, and beside another body, with nothing between.

What a gap separates feels nothing of the other side. A gap is closed by what falls or is pushed, refused, or noted.
"""

from dataclasses import replace

from unlike_contact import FLOOR, in_time
from unlike_scene import (
    BASES, IN_TIME, STATIC, Unlike, base_scene, changed, confined_modulus, log_uniform, material, points_of, rounded,
    settled, ways_of,
)  # fmt: skip

GAP = "gap|apart"  # in notes
REFUSED = f"{GAP}|above|reach|touch|beyond|not held|nothing holds"


def above_gap(r):
    """A column between rollers above a wall or a held face: (scene, size of its cells, its u on what is below)"""
    basis, nx, ny, h = r.choice(BASES), r.randint(1, 3), r.randint(4, 6), log_uniform(r, 0.05, 5)
    gap = r.choice([rounded(r.uniform(0.01, 1), 3), rounded(r.uniform(0.1, 2.5), 3), 0.5, 1.0, 0.8])
    m = material(r, r.choice(["linear-elastic", "hencky"]))
    size = [rounded(nx * h, 10), rounded((ny + 3) * h, 10)]
    low, high = rounded(gap * h, 8), rounded((3 + gap) * h, 8)
    points = [3, 3]
    body = {"min": [0.0, low], "max": [size[0], high], "points_per_cell": points}
    scene = base_scene(2, size, [nx, ny + 3], basis, body, m, "plane-strain")
    if m["law"] == "hencky":
        scene["phase"] = {"max_motion": r.choice([0.1, 0.3])}
    scene["stop"] |= {"residual": 1e-6, "steps": 8000}
    height = high - low
    g = rounded(log_uniform(r, 1e-5, 3e-3) * confined_modulus(m) / (m["rho"] * height))
    scene["body_force"] = {"value": [0.0, -g]}
    scene["support"] = [{"face": "left", "kind": "roller"}, {"face": "right", "kind": "roller"}]
    scene["title"] = f"{gap} cells above {{}}, {basis}, {m['law']}"
    exact = settled(height, m, g, low, -low)
    return scene, h, exact


def above_a_wall(r, all_ways=False):
    scene, h, exact = above_gap(r)
    scene["wall"] = [{"name": FLOOR, "face": "bottom"}]
    scene["title"] = scene["title"].format("a wall")
    ways = in_time(scene)
    return Unlike(
        scene, ways_of(r, ways, all_ways), exact=exact, tolerance=0.03, unique=0, components=(1,), cell=h, says=REFUSED
    )


def above_a_held_face(r, all_ways=False):
    scene, h, exact = above_gap(r)
    scene["support"].append({"face": "bottom", "kind": r.choice(["fixed", "roller"])})
    scene["title"] = scene["title"].format("a held face")
    ways = [*IN_TIME, *STATIC]
    return Unlike(
        scene, ways_of(r, ways, all_ways), exact=exact, tolerance=0.03, unique=0, components=(1,), cell=h, says=REFUSED
    )


def blocks_with_a_gap(r, all_ways=False):
    """Two blocks with a gap: the other one is held by nothing, or by its own face and feels nothing."""
    basis, h = r.choice(BASES), log_uniform(r, 0.05, 5)
    reach = {"linear": 0.95, "quadratic": 1.9, "cubic": 2.9}[basis]
    gap = rounded(r.uniform(0.01, reach), 3)
    ny, n = r.randint(1, 3), r.randint(2, 4)
    m = material(r, "linear-elastic")
    start = rounded((n + gap) * h, 8)
    end = rounded((n + 3 + gap) * h if r.random() < 0.5 else (n + 6) * h, 8)
    size = [rounded((n + 6) * h, 10), rounded(ny * h, 10)]
    held = end == size[0] and r.random() < 0.7
    pushed = r.choice([-1, 1])
    both = {"material": "m", "state": "plane-strain", "points_per_cell": points_of(r, basis, 2)}
    bodies = [{"max": [rounded(n * h, 10), size[1]]} | both, {"min": [start, 0.0], "max": [end, size[1]]} | both]
    scene = base_scene(2, size, [n + 6, ny], basis, {}, m, "plane-strain")
    scene["body"] = bodies
    scene["stop"] |= {"residual": 1e-7, "steps": 10000}
    p = rounded(log_uniform(r, 1e-6, 1e-3) * m["E"] * pushed)
    scene["support"] = [{"face": "left"}] + ([{"face": "right"}] if held else [])
    inner = [[start, 0.0], [start, size[1]]] if held else [[end, 0.0], [end, size[1]]]
    scene["traction"] = [{"line": inner, "value": [p, 0.0]}]
    scene["title"] = f"two blocks, {gap} cells apart, {basis}, the other held{'' if held else ' by nothing'}"
    ways = [*IN_TIME, "newton", "cg"]
    unlike = Unlike(scene, ways_of(r, ways, all_ways), tolerance=1e-2, unique=0, cell=h, notes=GAP, says=REFUSED)
    if not held:
        return replace(unlike, never="nothing holds the block beyond the gap")

    # The left one does not move; of the right one Newton's method has the answer of it alone.
    alone = changed(scene, body=[bodies[1]], support=[{"face": "right"}])
    return replace(unlike, answer=alone)


ACROSS_GAPS = [above_a_wall, above_a_held_face, blocks_with_a_gap]
