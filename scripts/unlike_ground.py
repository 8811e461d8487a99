"""Unlike scenes of ground: below its strength and beyond, rate-independent and viscoplastic, and driven to a limit."""

import math

from unlike_scene import Unlike, base_scene, changed, log_uniform, rounded, uniform, wave_time, ways_of

PATH = "overshoot|overshot|inertia carried|out of balance|load_steps|history"


def ground(r):
    """Both laws have the same strength in plane strain, if the cone dilates as it rubs or does not rub."""
    phi = r.choice([0, 0, 20, 30])
    E = log_uniform(r, 1e6, 1e9)
    soil = {
        "law": "drucker-prager", "E": E, "nu": r.choice([0.2, 0.3, 0.4, 0.49]), "rho": log_uniform(r, 500, 3000),
        "phi": phi, "psi": r.choice([0, phi]), "c": rounded(E * log_uniform(r, 1e-5, 1e-3)), "cone": "plane-strain",
    }  # fmt: skip
    if r.random() < 0.5:
        del soil["cone"]
        soil["law"] = "mohr-coulomb"
    return soil


def strength(m):
    """Of a block in plane strain that is free to its side: σ₁ − σ₃ at collapse."""
    phi = math.radians(m["phi"])
    return 2 * m["c"] * math.cos(phi) / (1 - math.sin(phi))


def loaded(r, m, q):
    """A block between two rollers, pressed with q or drawn out with -q, at a stroke or slowly."""
    n, h = r.randint(1, 3), log_uniform(r, 0.1, 5)
    basis = r.choice(["linear", "linear", "quadratic"]) if n > 1 else "linear"
    size = [rounded(n * h, 10)] * 2
    points = [3, 3] if basis == "quadratic" else [2, 2]
    scene = base_scene(2, size, [n, n], basis, {"points_per_cell": points}, m, "plane-strain")
    scene["stop"] |= {"residual": 1e-7, "steps": 10000}
    scene["support"] = [{"face": "left", "kind": "roller"}, {"face": "bottom", "kind": "roller"}]
    T = wave_time(m, size[1])
    load = r.choice([f"{-q}*min(t/{rounded(60 * T)}, 1)", f"{-q}"])
    if "t" in load:
        scene["stop"]["time"] = rounded(4000 * T)
    scene["traction"] = [{"face": "top", "value": [0.0, load]}]
    return scene, h


GROUND_WAYS = ["viscous", "one-sided", "cundall", "kinetic", "adaptive", "fire", "auto", "newton", "lbfgs", "cg"]


def block_of_ground(r, all_ways=False):
    """Below its strength the block is elastic. Drawn out beyond it, it never rests, by no law that flows in time
    either; pressed beyond it, it may spread until its face has grown enough for a load per undeformed area."""
    m, viscous = ground(r), r.random() < 0.4
    if viscous and m["law"] == "drucker-prager":
        m["fluidity"] = rounded(10 ** r.uniform(-12, -4))
    kind, drawn = r.choice(["below", "beyond", "beyond"]), r.random() < 0.5
    share = uniform(r, 0.2, 0.6) if kind == "below" else uniform(r, 1.15, 3)
    phi = math.radians(m["phi"])
    most = 2 * m["c"] * math.cos(phi) / (1 + math.sin(phi)) if drawn else strength(m)
    q = rounded(-share * most if drawn else share * most)
    scene, h = loaded(r, m, q)
    of = "viscoplastic" if "fluidity" in m else "plastic"
    done = "drawn" if drawn else "pressed"
    scene["title"] = f"a block of {of} ground, phi = {m['phi']}, {done} by {share} of its strength"
    ways = ways_of(r, GROUND_WAYS, all_ways)
    if kind == "below":
        elastic = {key: m[key] for key in ("E", "nu", "rho")} | {"law": "linear-elastic"}
        answer = changed(scene, material={"m": elastic}, traction=[{"face": "top", "value": [0.0, -q]}])
        return Unlike(scene, ways, answer=answer, tolerance=1e-2, unique=1e-3, cell=h, notes=PATH, needed=True)
    if drawn:
        return Unlike(scene, ways, never=f"it bears {share} of its strength", unique=0, cell=h, squeezed=True)
    return Unlike(scene, ways, unique=0, cell=h, strong=True, squeezed=True)


def strip_on_ground(r, all_ways=False):
    """A strip load on ground: a part of what it bears, put on slowly, or half as much again as it bears."""
    m = ground(r) | {"phi": 0, "psi": 0}
    n, h = [r.randint(8, 10), r.randint(5, 7)], log_uniform(r, 0.1, 2)
    size = [rounded(k * h, 10) for k in n]
    scene = base_scene(2, size, n, "linear", {"points_per_cell": [2, 2], "placement": "gauss"}, m, "plane-strain")
    scene["phase"]["dilatation"] = "cells"
    scene["stop"] |= {"residual": 1e-6, "steps": 10000}
    scene["support"] = [{"face": "bottom"}, {"face": "left", "kind": "roller"}, {"face": "right", "kind": "roller"}]
    beyond = r.random() < 0.35
    share, T = (uniform(r, 1.7, 3) if beyond else uniform(r, 0.2, 0.75)), wave_time(m, size[1])
    q = rounded(share * (2 + math.pi) * m["c"])
    line = [[0.0, size[1]], [rounded(2 * h, 10), size[1]]]
    scene["traction"] = [{"line": line, "value": [0.0, f"-{q}*min(t/{rounded(200 * T)}, 1)"]}]
    scene["stop"]["time"] = rounded(3000 * T)
    scene["title"] = f"a strip on clay, {share} of its limit load"
    ways = ways_of(r, GROUND_WAYS[:-2], all_ways)
    if beyond:
        return Unlike(scene, ways, never=f"it bears {share} of Prandtl's load", cell=h)
    answer = changed(scene, solve={"load_steps": 20}, traction=[scene["traction"][0] | {"value": [0.0, -q]}])
    return Unlike(scene, ways, answer=answer, tolerance=0.02, unique=0, cell=h, notes=PATH)


def driven_load(r, all_ways=False):
    """The limit load of a block of ground, by a displacement: λ σ = its strength, whatever its stiffness."""
    m = ground(r)
    if r.random() < 0.3:
        m["nu"] = r.choice([0.499, 0.4999, 0.499999, 0.4999999])
    scene, h = loaded(r, m, strength(m))
    p = rounded(m["c"] * log_uniform(r, 0.1, 10))
    height = scene["grid"]["max"][1]
    d = rounded(strength(m) / m["E"] * height * log_uniform(r, 2, 50))
    slow = log_uniform(r, 20, 3000)
    T = wave_time(m | {"nu": 0.3}, height)
    scene["traction"] = [{"face": "top", "value": [0.0, -p]}]
    scene["load"] = {"displacement": f"{d}*t/{rounded(slow * T)}"}
    growth = r.choice([0.01, 0.01, 0.1])
    scene["stop"] = {"residual": 0, "load_growth": growth, "time": rounded(slow * T), "steps": 40000}
    of = f"phi = {m['phi']}, nu = {m['nu']}"
    scene["title"] = f"the limit load of a block of ground, {of}, within {slow} wave times"
    ways = ways_of(r, ["cundall", "viscous", "one-sided", "combined", "adaptive", "auto"], all_ways, 2)
    return Unlike(scene, ways, factor=strength(m) / p, tolerance=0.06, cell=h, notes=PATH)


OF_GROUND = [block_of_ground, block_of_ground, strip_on_ground, driven_load]
