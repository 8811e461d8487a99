"""Unlike scenes of elastic bodies without walls: axes of symmetry, loads and supports that come late, tiny loads, few
points, flat cells, pressure that follows, several bodies."""

from unlike_scene import (
    BASES, IN_TIME, STATIC, Unlike, base_scene, changed, log_uniform, material, points_of, rounded, uniform, wave_time,
    ways_of,
)  # fmt: skip

ROUNDING = "round|resolve"
ELASTIC = ["linear-elastic", "linear-elastic", "neo-hookean", "hencky"]


def elastic_block(r, law, cells=(1, 5), basis=None, state="plane-strain", nu=None):
    """A block that fills its grid: (scene, its material, its size)"""
    basis = basis or r.choice(BASES)
    n, h = [r.randint(*cells), r.randint(*cells)], log_uniform(r, 0.05, 5)
    size = [rounded(k * h, 10) for k in n]
    m = material(r, law, nu)
    scene = base_scene(2, size, n, basis, {"points_per_cell": points_of(r, basis, 2)}, m, state)
    scene["stop"] |= {"residual": 1e-8, "steps": 15000}
    return scene, m, size


# --- an axis of symmetry -------------------------------------------------------------------------------


def about_an_axis(r, all_ways=False):
    """A body that reaches the axis: its answer is the same with a roller there, or without one. A hole is free."""
    basis, law = r.choice(BASES), r.choice(ELASTIC)
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
        tolerance=0.05 if in_phases else 1e-4,
        unique=0.03 if in_phases else 1e-5,
        cell=h,
        notes="cross the cells of a linear basis|varies faster" if in_phases else "",
        needed=True,
    )


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
        later = f"{part}*min(max((t - {t2})/{t1}, 0), 1)"
        return f"{value}*(min(t/{t1}, 1) + {later})", rounded(value * (1 + part), 10), t1 + t2
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
    return Unlike(scene, ways, answer=answer, tolerance=3e-3, unique=0, cell=size[1], notes=ROUNDING, needed=True)


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
    basis, aspect = r.choice(BASES), r.choice([log_uniform(r, 5, 100), 100])
    n, h = [r.randint(2, 4), r.randint(2, 4)], log_uniform(r, 0.05, 5)
    d = [rounded(h * aspect), h] if r.random() < 0.5 else [h, rounded(h * aspect)]
    size = [rounded(k * e, 10) for k, e in zip(n, d)]
    m = material(r, r.choice(ELASTIC))
    scene = base_scene(2, size, n, basis, {"points_per_cell": points_of(r, basis, 2)}, m, "plane-strain")
    scene["stop"] |= {"residual": 1e-8, "steps": 10000}
    scene["support"] = [{"face": r.choice(["left", "bottom"])}]
    strain = log_uniform(r, 1e-6, 1e-4)
    g = strain * m["E"] / (m["rho"] * max(size) * aspect)
    scene["body_force"] = {"value": [rounded(g * r.uniform(-1, 1)) for _ in n]}
    scene["title"] = f"cells of 1:{aspect}, {basis}, {m['law']}"
    answer = changed(scene)
    ways = ways_of(r, [*IN_TIME, *STATIC], all_ways)
    return Unlike(scene, ways, answer=answer, tolerance=1e-3, unique=0, cell=d[1], notes=ROUNDING)


def following_pressure(r, all_ways=False):
    """Pressure along the normal of the deformed face, at large strain; on a part of a face it has no potential."""
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
    basis, h, n = r.choice(BASES), log_uniform(r, 0.05, 5), r.randint(2, 4)
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
        box = {"min": low, "max": high, "points_per_cell": points}
        bodies.append(box | {"material": f"m{k}", "state": "plane-strain"})
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
    return Unlike(scene, ways, answer=changed(scene), tolerance=1e-3, unique=0, cell=h, notes=ROUNDING)


BODIES = [
    about_an_axis, about_an_axis, staged_loads, late_support, tiny_loads, one_point_a_cell, flat_cells,
    following_pressure, several_bodies,
]  # fmt: skip
