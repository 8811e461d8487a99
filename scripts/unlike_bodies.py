"""Unlike scenes without walls: axes of symmetry, ground that yields or flows, limit loads, loads and supports that come
late, tiny loads, few points, flat cells, pressure that follows, several bodies."""

import math

from unlike_scene import (
    IN_TIME, STATIC, Unlike, base_scene, changed, confined_modulus, log_uniform, material, points_of, rounded, some, uniform,
    wave_time,
)  # fmt: skip

PATH = "overshoot|overshot|inertia carried|out of balance|load_steps|history"
ELASTIC = ["linear-elastic", "linear-elastic", "neo-hookean", "hencky"]


def ways_of(r, ways, all_ways, count=3):
    return ways if all_ways else some(r, ways, count)


def elastic_block(r, law, cells=(1, 5), basis=None, state="plane-strain", nu=None):
    """A block that fills its grid: (scene, its material, size)."""
    basis = basis or r.choice(["linear", "quadratic", "cubic"])
    n, h = [r.randint(*cells), r.randint(*cells)], log_uniform(r, 0.05, 5)
    size = [rounded(k * h, 10) for k in n]
    m = material(r, law, nu)
    scene = base_scene(2, size, n, basis, {"points_per_cell": points_of(r, basis, 2)}, m, state)
    scene["stop"] |= {"residual": 1e-8, "steps": 15000}
    return scene, m, size


# --- an axis of symmetry -------------------------------------------------------------------------------


def about_an_axis(r, all_ways=False):
    """A body that reaches the axis: with a roller there, or without one, its answer is the same. One with a hole is free."""
    basis, law = r.choice(["linear", "quadratic", "cubic"]), r.choice(ELASTIC)
    n, h = [r.randint(3, 6), r.randint(2, 6)], log_uniform(r, 0.05, 5)
    hole = r.choice([0, 0, 0, 1, 2])  # cells
    size = [rounded((n[0] + hole + 1) * h, 10), rounded((n[1] + 1) * h, 10)]
    low, high = [rounded(hole * h, 10), 0.0], [rounded((n[0] + hole) * h, 10), rounded(n[1] * h, 10)]
    m = material(r, law, r.choice([0.0, 0.2, 0.3, 0.45]))
    body = {"min": low, "max": high, "points_per_cell": points_of(r, basis, 2)}
    scene = base_scene(2, size, [n[0] + hole + 1, n[1] + 1], basis, body, m, "axisymmetric")
    in_phases = law != "linear-elastic" and r.random() < 0.5
    p = rounded(m["E"] * (log_uniform(r, 1e-5, 1e-2) if law == "linear-elastic" else uniform(r, 0.01, 0.12)))
    scene["support"] = [{"face": "bottom", "kind": r.choice(["fixed", "roller"])}]
    loaded = rounded(low[0] + (high[0] - low[0]) * r.choice([0.5, 1.0]), 10)
    kind = r.choice(["top", "weight", "squeezed"])
    if kind == "top":
        scene["traction"] = [{"line": [[low[0], high[1]], [loaded, high[1]]], "value": [0.0, -p]}]
    elif kind == "weight":
        scene["body_force"] = {"value": [0.0, rounded(-p / (m["rho"] * high[1]))]}
    else:
        scene["traction"] = [{"face": "right", "pressure": p}]
    answer = changed(scene, support=[*scene["support"], *([] if hole else [{"face": "left", "kind": "roller"}])])
    if in_phases:
        scene["phase"] = {"max_motion": r.choice([0.1, 0.3]), "quadrature": "points"}
        scene["stop"]["residual"] = 1e-6
    where = f"a hole of {hole} cells" if hole else "to the axis"
    scene["title"] = f"axisymmetric, {where}, {basis}, {law}, {kind}{', in phases' if in_phases else ''}"
    return Unlike(
        scene,
        ways_of(r, IN_TIME if in_phases else [*IN_TIME, *STATIC], all_ways),
        answer=answer,
        tolerance=0.03 if in_phases else 1e-4,
        unique=0.01 if in_phases else 1e-5,
        cell=h,
        notes="cross the cells of a linear basis" if in_phases else "",
        needed=True,
    )


# --- ground that yields --------------------------------------------------------------------------------


def ground(r, psi=True):
    phi = r.choice([0, 0, 20, 30])
    E = log_uniform(r, 1e6, 1e9)
    return {
        "law": "drucker-prager", "E": E, "nu": r.choice([0.2, 0.3, 0.4, 0.49]), "rho": log_uniform(r, 500, 3000),
        "phi": phi, "psi": r.choice([0, phi]) if psi else 0, "c": rounded(E * log_uniform(r, 1e-5, 1e-3)), "cone": "plane-strain",
    }  # fmt: skip


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
    """Below its strength the block is elastic. Drawn out beyond it, it never rests, by no law that flows in time either;
    pressed beyond it, it may spread until its face has grown enough for a load per undeformed area."""
    m, viscous = ground(r), r.random() < 0.4
    if viscous:
        m["fluidity"] = rounded(10 ** r.uniform(-12, -4))
    kind, drawn = r.choice(["below", "beyond", "beyond"]), r.random() < 0.5
    share = uniform(r, 0.2, 0.6) if kind == "below" else uniform(r, 1.15, 3)
    phi = math.radians(m["phi"])
    most = 2 * m["c"] * math.cos(phi) / (1 + math.sin(phi)) if drawn else strength(m)
    q = rounded(-share * most if drawn else share * most)
    scene, h = loaded(r, m, q)
    of = "viscoplastic" if viscous else "plastic"
    scene["title"] = f"a block of {of} ground, phi = {m['phi']}, {'drawn' if drawn else 'pressed'} by {share} of its strength"
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
    m = ground(r, psi=False) | {"phi": 0, "psi": 0}
    n, h = [r.randint(8, 10), r.randint(5, 7)], log_uniform(r, 0.1, 2)
    size = [rounded(k * h, 10) for k in n]
    scene = base_scene(2, size, n, "linear", {"points_per_cell": [2, 2], "placement": "gauss"}, m, "plane-strain")
    scene["phase"]["dilatation"] = "cells"
    scene["stop"] |= {"residual": 1e-6, "steps": 10000}
    scene["support"] = [{"face": "bottom"}, {"face": "left", "kind": "roller"}, {"face": "right", "kind": "roller"}]
    beyond = r.random() < 0.35
    share, T = (uniform(r, 1.7, 3) if beyond else uniform(r, 0.2, 0.75)), wave_time(m, size[1])
    q = rounded(share * (2 + math.pi) * m["c"])
    scene["traction"] = [{"line": [[0.0, size[1]], [rounded(2 * h, 10), size[1]]], "value": [0.0, f"-{q}*min(t/{rounded(200 * T)}, 1)"]}]
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
    scene["stop"] = {"residual": 0, "load_growth": r.choice([0.01, 0.01, 0.1]), "time": rounded(slow * T), "steps": 40000}
    scene["title"] = f"the limit load of a block of ground, phi = {m['phi']}, nu = {m['nu']}, within {slow} wave times"
    ways = ways_of(r, ["cundall", "viscous", "one-sided", "combined", "adaptive", "auto"], all_ways, 2)
    return Unlike(scene, ways, factor=strength(m) / p, tolerance=0.06, cell=h, notes=PATH)


# --- loads and supports in t ---------------------------------------------------------------------------


def in_stages(r, T, value):
    """(formula, its last value, when it is reached)"""
    t1 = rounded(T * r.choice([r.uniform(0.5, 30), log_uniform(r, 30, 1500)]))
    t2, part = rounded(t1 + T * log_uniform(r, 0.2, 60)), rounded(r.uniform(-1.5, 2))
    kind = r.randint(0, 5)
    if kind == 0:
        return f"{value}*(t>={t1})", value, t1
    if kind == 1:
        return f"{value}*(1 + {part}*(t>={t1}))", rounded(value * (1 + part), 10), t1
    if kind == 2:
        return f"{value}*(1 + {part}*(t>={t1})*(t<{t2}))", value, t2
    if kind == 3:
        return f"{value}*min(max((t - {t1})/{rounded(t2 - t1)}, 0), 1)", value, t2
    if kind == 4:
        return f"{value}*(min(t/{t1}, 1) + {part}*min(max((t - {t2})/{t1}, 0), 1))", rounded(value * (1 + part), 10), t1 + t2
    return f"{value}*(1 - exp(-t/{rounded(t1 / 5)}))", value, 8 * t1


def staged_loads(r, all_ways=False):
    """Loads that come in steps, ramps and pulses, late or early: at rest is what is at rest under the last of them."""
    scene, m, size = elastic_block(r, "linear-elastic")
    T, strain = wave_time(m, max(size)), log_uniform(r, 1e-6, 1e-2)
    scene["support"] = [{"face": "bottom"}]
    formula, last, t_end = in_stages(r, T, rounded(-strain * m["E"] / (m["rho"] * size[1])))
    scene["body_force"] = {"value": [0.0, formula]}
    answer = changed(scene, body_force={"value": [0.0, last]})
    if r.random() < 0.5:
        formula, other, t_2 = in_stages(r, T, rounded(strain * m["E"] * r.uniform(-0.2, 0.2)))
        scene["traction"] = [{"face": "top", "value": [formula, 0.0]}]
        answer["traction"] = [{"face": "top", "value": [other, 0.0]}]
        t_end = max(t_end, t_2)
    if r.random() < 0.8:
        scene["stop"]["time"] = rounded(t_end + 3000 * T)
    scene["title"] = f"loads in stages, {scene['grid']['basis']}"
    ways = ways_of(r, [*IN_TIME, *STATIC], all_ways)
    return Unlike(scene, ways, answer=answer, tolerance=1e-4, unique=1e-4, cell=size[1], needed=True)


def late_support(r, all_ways=False):
    """A support that begins to move late, at a stroke or by a ramp, and may come back."""
    law = r.choice(ELASTIC)
    scene, m, size = elastic_block(r, law)
    T = wave_time(m, max(size))
    d = rounded(size[1] * (log_uniform(r, 1e-6, 1e-2) if law == "linear-elastic" else r.uniform(-0.1, 0.1)))
    formula, last, t_end = in_stages(r, T, d)
    if abs(last) > 0.2 * size[1]:
        formula, last, t_end = f"{d}*(t>={rounded(5 * T)})", d, 5 * T
    scene["support"] = [{"face": "bottom"}, {"face": "top", "kind": r.choice(["fixed", "roller"]), "u": formula}]
    answer = changed(scene, support=[scene["support"][0], scene["support"][1] | {"u": last}])
    if r.random() < 0.5:
        scene["body_force"] = {"value": [0.0, rounded(-1e-3 * m["E"] / (m["rho"] * size[1]))]}
        answer["body_force"] = scene["body_force"]
    if r.random() < 0.8:
        scene["stop"]["time"] = rounded(t_end + 3000 * T)
    scene["title"] = f"a support that moves late, {scene['grid']['basis']}, {law}"
    ways = ways_of(r, [*IN_TIME, *STATIC], all_ways)
    return Unlike(scene, ways, answer=answer, tolerance=1e-4, unique=1e-4, cell=size[1])


# --- small numbers, few points, flat cells -------------------------------------------------------------


def tiny_loads(r, all_ways=False):
    """Loads that strain a large-strain law by 1e-6 to 1e-20: the answer is that of the linear law."""
    law = r.choice(["neo-hookean", "hencky"])
    scene, m, size = elastic_block(r, law, (2, 4))
    scene["body"]["placement"] = r.choice(["uniform", "gauss"])
    strain = log_uniform(r, 1e-20, 1e-6)
    scene["stop"] |= {"residual": r.choice([1e-6, 1e-7, 1e-8]), "steps": 10000}
    scene["support"] = [{"face": r.choice(["left", "bottom"])}]
    load = strain * m["E"]
    scene["body_force"] = {"value": [0.0, rounded(-load / (m["rho"] * max(size)))]}
    if r.random() < 0.5:
        scene["traction"] = [{"face": "top", "pressure": rounded(load * r.uniform(0.1, 1))}]
    answer = changed(scene, material={"m": m | {"law": "linear-elastic"}})
    answer["stop"] = {"residual": 1e-8}
    if r.random() < 0.4:
        scene["phase"] = {"max_motion": 0.1, "quadrature": "points"}
    scene["title"] = f"strain {strain}, {scene['grid']['basis']}, {law}"
    ways = ways_of(r, [*IN_TIME, *(STATIC if scene["phase"]["max_motion"] == "none" else [])], all_ways)
    return Unlike(scene, ways, answer=answer, tolerance=3e-3, unique=0, cell=size[1], notes="round|resolve", needed=True)


def one_point_a_cell(r, all_ways=False):
    """Motions of the grid that strain no point, and which the load does not drive, or does."""
    space, h = r.random() < 0.6, log_uniform(r, 0.05, 5)
    n = [r.randint(2, 5), r.randint(1, 3), r.randint(1, 3)][: 3 if space else 2]
    flat = [rounded(h * r.choice([1, 1, 0.5, 2])) for _ in n]
    size = [rounded(k * d, 10) for k, d in zip(n, flat)]
    m = material(r, r.choice(["linear-elastic", "linear-elastic", "neo-hookean"]))
    body = {"points_per_cell": [1] * len(n)}
    scene = base_scene(len(n), size, n, "linear", body, m, "space" if space else "plane-strain")
    scene["stop"] |= {"residual": 1e-7, "steps": 10000}
    scene["support"] = [{"face": "left"}]
    g = rounded(log_uniform(r, 1e-6, 1e-3) * m["E"] / (m["rho"] * size[0]))
    pull = [0.0, -g, 0.0][: len(n)] if r.random() < 0.7 else [rounded(g * r.uniform(-1, 1)) for _ in n]
    scene["body_force"] = {"value": pull}
    corner = [size[0], *[rounded(s / 2, 10) for s in size[1:]]]
    scene["probe"] = [{"name": "end", "at": corner, "fields": [f"u.{'xyz'[k]}" for k in range(len(n))]}]
    scene["title"] = f"one point a cell in {len(n)} dimensions, {m['law']}"
    ways = ways_of(r, ["viscous", "cundall", "kinetic", "auto", "fire", "chebyshev", *STATIC], all_ways, 4)
    return Unlike(scene, ways, unique=0.01, cell=h, notes="one point|few|null|hourglass|singular|strain no")


def flat_cells(r, all_ways=False):
    """Cells of 1:100."""
    basis, aspect = r.choice(["linear", "quadratic", "cubic"]), r.choice([log_uniform(r, 5, 100), 100])
    n, h = [r.randint(2, 4), r.randint(2, 4)], log_uniform(r, 0.05, 5)
    d = [rounded(h * aspect), h] if r.random() < 0.5 else [h, rounded(h * aspect)]
    size = [rounded(k * e, 10) for k, e in zip(n, d)]
    m = material(r, r.choice(ELASTIC))
    scene = base_scene(2, size, n, basis, {"points_per_cell": points_of(r, basis, 2)}, m, "plane-strain")
    scene["stop"] |= {"residual": 1e-8, "steps": 10000}
    scene["support"] = [{"face": r.choice(["left", "bottom"])}]
    strain = log_uniform(r, 1e-6, 1e-4)
    scene["body_force"] = {"value": [rounded(strain * m["E"] / (m["rho"] * max(size)) * r.uniform(-1, 1) / aspect) for _ in n]}
    scene["title"] = f"cells of 1:{aspect}, {basis}, {m['law']}"
    answer = changed(scene)
    ways = ways_of(r, [*IN_TIME, *STATIC], all_ways)
    return Unlike(scene, ways, answer=answer, tolerance=1e-3, unique=0, cell=d[1], notes="round|resolve")


def following_pressure(r, all_ways=False):
    """Pressure along the normal of the deformed face, at large strain; its stiffness has no potential on a part of it."""
    law = r.choice(["neo-hookean", "hencky"])
    scene, m, size = elastic_block(r, law, (2, 5), nu=r.choice([0.0, 0.2, 0.3]))
    slender = max(size) / min(size)
    p = rounded(m["E"] * r.choice([-1, 1]) * log_uniform(r, 1e-3, 0.15) / slender**3)
    scene["support"] = [{"face": "bottom"}]
    scene["traction"] = [{"face": r.choice(["top", "left", "right"]), "pressure": p}]
    scene["title"] = f"a pressure that follows, {scene['grid']['basis']}, {law}"
    ways = ways_of(r, ["newton", "newton-cg", "cg", "lbfgs", *IN_TIME], all_ways, 4)
    return Unlike(scene, ways, answer=changed(scene), tolerance=1e-4, unique=1e-4, cell=size[1])


def several_bodies(r, all_ways=False):
    """Two to four bodies that touch, of moduli and densities that differ, one a support for the next or beside it."""
    basis, h, n = r.choice(["linear", "quadratic", "cubic"]), log_uniform(r, 0.05, 5), r.randint(2, 4)
    each, across, law = r.randint(1, 3), r.randint(1, 3), r.choice(ELASTIC)
    sideways = r.random() < 0.3
    size = [rounded(across * h, 10), rounded(each * n * h, 10)]
    bodies, materials = [], {}
    E = log_uniform(r, 1, 1e8)
    points = points_of(r, basis, 2)
    for k in range(n):
        materials[f"m{k}"] = material(r, law, E=rounded(E * log_uniform(r, 1e-3, 1e3)))
        low, high = [0.0, rounded(each * k * h, 10)], [size[0], rounded(each * (k + 1) * h, 10)]
        if sideways:
            low, high = low[::-1], high[::-1]
        bodies.append({"min": low, "max": high, "material": f"m{k}", "state": "plane-strain", "points_per_cell": points})
    cells = [across, each * n]
    if sideways:
        size, cells = size[::-1], cells[::-1]
    softest = min(m["E"] for m in materials.values())
    heaviest = max(m["rho"] for m in materials.values())
    scene = base_scene(2, size, cells, basis, {}, {}, "plane-strain")
    scene["body"], scene["material"] = bodies, materials
    scene["stop"] |= {"residual": 1e-8, "steps": 12000}
    scene["support"] = [{"face": "bottom"}]
    g = rounded(log_uniform(r, 1e-5, 1e-3 if law == "linear-elastic" else 0.02) * softest / (heaviest * max(size)))
    scene["body_force"] = {"value": [rounded(0.1 * g * r.uniform(-1, 1)), -g]}
    scene["title"] = f"{n} bodies {'side by side' if sideways else 'in a pile'}, {basis}, {law}"
    ways = ways_of(r, [*IN_TIME, *STATIC], all_ways)
    return Unlike(scene, ways, answer=changed(scene), tolerance=1e-3, unique=0, cell=h, notes="round|resolve")


BODIES = [
    about_an_axis, about_an_axis, block_of_ground, block_of_ground, strip_on_ground, driven_load, staged_loads, late_support,
    tiny_loads, one_point_a_cell, flat_cells, following_pressure, several_bodies,
]  # fmt: skip
