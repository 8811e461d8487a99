"""Unlike scenes with walls: elastic bodies that open, close, are thrown, pushed and moved.

The equilibrium of an elastic body on smooth walls is unique: every way there has to give it. Where all of a face ends
up on its wall, a roller in the place of the wall has the same one.
"""

import math

from unlike_scene import (
    BASES, IN_TIME, Unlike, base_scene, changed, confined_modulus, log_uniform, material, points_of, rounded, wave_time,
    ways_of,
)  # fmt: skip

FLOOR = "floor"
# What the points of a body that is thrown about keep from phase to phase differs from way to way: measured up to 3.9 %,
# or 0.0013 of a cell.
IN_PHASES, OF_CELL = 0.05, 2e-3
NOT_IF_A_WALL_MOVES = {"kinetic", "fire", "fire2", "nesterov"}  # set velocities to 0, the wall's too: refused


def in_time(scene):
    """The ways that a scene with walls allows."""
    moves = any("t" in str(wall.get("motion", "")) for wall in scene["wall"])
    return [way for way in IN_TIME if not (moves and way in NOT_IF_A_WALL_MOVES)]


# --- what happens on the way ---------------------------------------------------------------------------


def disturbed(r, scene, kind, g, T, way_up, axis):
    """Adds what lifts, throws or pushes the body, and how it comes to rest is its own affair. Returns how far the wall
    has moved in the end. g: the weight along axis, T: a wave's time, way_up: how far up it goes, about."""
    pull = list(scene["body_force"]["value"])
    t1 = rounded(r.uniform(1, 20) * T)
    if kind in ("thrown", "thrown down", "above", "inside") and scene["grid"]["basis"] != "linear":
        scene["body"]["points_per_cell"] = [4] * scene["dim"] if scene["dim"] > 1 else 4  # values that can be fitted
    lifted = [0.0] * scene["dim"]
    moved = 0.0
    if kind == "pulse":
        strength = rounded(2 * way_up / (g * t1**2) + 1)
        pull[axis] = f"{-g} + {rounded(g * (1 + strength))}*(t<{t1})"
    elif kind == "later pulse":
        strength = rounded(2 * way_up / (g * t1**2) + 1)
        pull[axis] = f"{-g} + {rounded(g * (1 + strength))}*(t>{rounded(10 * T)})*(t<{rounded(10 * T + t1)})"
    elif kind == "thrown":
        lifted[axis] = rounded((2 * g * way_up) ** 0.5)
        scene["initial"] = {"v": lifted}
    elif kind == "thrown down":
        lifted[axis] = -rounded((2 * g * way_up) ** 0.5)
        scene["initial"] = {"v": lifted}
    elif kind == "above":
        lifted[axis] = way_up
        scene["initial"] = {"u": lifted}
    elif kind == "inside":
        lifted[axis] = -way_up
        scene["initial"] = {"u": lifted}
    elif kind == "lying":
        pass
    else:
        moved = rounded(r.choice([-1, 1, 1]) * way_up)
        scene["wall"][0]["motion"] = {
            "constant": f"{moved}",
            "ramp": f"{moved}*min(t/{t1}, 1)",
            "step": f"{moved}*(t>={t1})",
            "there and back": f"{moved}*(min(t/{t1}, 1) - min(max(t/{t1} - 2, 0), 1))",
            "beats": f"{moved}*(t>={t1})*(1 - (t>={2 * t1})*(t<{3 * t1}))",
        }[kind]
        moved = 0.0 if kind == "there and back" else moved
    scene["body_force"]["value"] = pull if scene["dim"] > 1 else pull[0]
    if "t" in f"{scene['body_force']['value']}{scene['wall'][0].get('motion', '')}":
        scene["stop"]["time"] = rounded(4000 * T)
    return moved


KINDS = [
    "pulse", "later pulse", "thrown", "thrown down", "above", "inside", "lying", "constant", "ramp", "step",
    "there and back", "beats",
]  # fmt: skip


def disturb(r, scene, m, g, height, h, axis, kinds=None):
    """The same with a choice of its own: (kind, how far the wall has moved). The damping is about critical: where walls
    alone hold a body it has no lowest frequency of its own."""
    scene["damping"]["c"] = rounded(math.pi / wave_time(m, height))
    kind = r.choice(kinds or KINDS)
    settlement = m["rho"] * g * height**2 / (2 * confined_modulus(m))
    way_up = rounded(min(settlement * r.uniform(0.1, 30), 0.4 * h))
    return kind, disturbed(r, scene, kind, g, wave_time(m, height), way_up, axis)


# --- on one wall ---------------------------------------------------------------------------------------


def column_on_wall(r, all_ways=False):
    """A column between rollers, a free block without lateral strain, or a bar, on a wall; pressed besides or not."""
    dim, basis = r.choice([1, 2, 2, 2, 3]), r.choice(BASES)
    free = dim == 2 and r.random() < 0.3
    across, up, h = (3 if free else r.randint(1, 3)), r.randint(2, 6 if dim < 3 else 3), log_uniform(r, 0.05, 5)
    room = r.choice([0, 1, 2])  # cells above it
    m = material(r, r.choice(["linear-elastic", "linear-elastic", "neo-hookean", "hencky"]), 0.0 if free else None)
    cells = [up + room] if dim == 1 else [across] * (dim - 1) + [up + room]
    axis, height = dim - 1, rounded(up * h, 10)
    size = [rounded(n * h, 10) for n in cells]
    top = [*size[:-1], height]
    body = {"min": [0.0] * dim, "max": top, "points_per_cell": points_of(r, basis, dim)}
    if free:
        body["min"][0], body["max"][0] = rounded(h, 10), rounded(2 * h, 10)
    state = {1: "uniaxial-strain", 2: "plane-strain", 3: "space"}[dim]
    scene = base_scene(dim, size, cells, basis, body, m, state)
    g = rounded(log_uniform(r, 1e-6, 1e-2) * confined_modulus(m) / (m["rho"] * height))
    scene["body_force"] = {"value": [0.0] * axis + [-g]}
    faces = {1: [], 2: ["left", "right"], 3: ["left", "right", "bottom", "top"]}[dim]
    scene["support"] = [] if free else [{"face": face, "kind": "roller"} for face in faces]
    floor = {1: "left", 2: "bottom", 3: "back"}[dim]
    scene["wall"] = [{"name": FLOOR, "face": floor}]
    if dim > 1 and r.random() < 0.25:  # pressed besides
        p = rounded(m["rho"] * g * height * r.uniform(0.2, 3))
        face = {2: "top", 3: "front"}[dim]
        scene["traction"] = [{"face": face, "value": [0.0] * axis + [-p]}]
    kind, moved = disturb(r, scene, m, g, height, h, axis)
    middle = [rounded((low + high) / 2, 10) for low, high in zip(body["min"], body["max"])][:-1]
    scene["probe"] = [{"name": "base", "at": [*middle, 0.0], "fields": [f"u.{'xyz'[axis]}"]}]
    if dim == 1:
        scene["probe"] = [{"name": "base", "at": 0.0, "fields": ["u"]}]
    # without the wall, and with the loads of the end
    held = {"face": floor, "u": moved, "kind": "roller"} if dim > 1 else {"at": 0.0, "u": moved}
    steady = [0.0] * axis + [-g]
    answer = changed(scene, wall=None, initial=None, body_force={"value": steady if dim > 1 else -g})
    answer["support"] = [*scene["support"], held]
    if free:
        answer["support"].append({"at": [middle[0], 0.0], "component": 0})
    scene["title"] = f"on a wall in {dim} dimensions, {basis}, {m['law']}, {kind}{', free' if free else ''}"
    return Unlike(
        scene,
        ways_of(r, in_time(scene), all_ways, 4),
        answer=answer,
        components=(axis,),
        moved=moved,
        cell=h,
        touching={"base": moved},
        needed=True,
    )


def block_in_corner(r, all_ways=False):
    """A block in a corner of two smooth walls under gravity that is tilted into it. It may lean, and open a part."""
    basis, nx, ny, h = r.choice(BASES), r.randint(1, 4), r.randint(1, 4), log_uniform(r, 0.05, 5)
    m = material(r, r.choice(["linear-elastic", "linear-elastic", "hencky"]))
    cells = [nx + 1, ny + 1]
    size, high = [rounded(n * h, 10) for n in cells], [rounded(nx * h, 10), rounded(ny * h, 10)]
    body = {"max": high, "points_per_cell": points_of(r, basis, 2)}
    scene = base_scene(2, size, cells, basis, body, m, r.choice(["plane-strain", "plane-strain", "plane-stress"]))
    if m["law"] != "linear-elastic":
        scene["body"]["state"] = "plane-strain"
    g = rounded(log_uniform(r, 1e-6, 3e-3) * m["E"] / (m["rho"] * max(high)))
    tilted = rounded(g * r.uniform(0.2, 1.5))
    scene["body_force"] = {"value": [-tilted, -g]}
    scene["wall"] = [{"name": FLOOR, "face": "bottom"}, {"name": "side", "face": "left"}]
    kind, moved = disturb(r, scene, m, g, high[1], h, 1)
    if "initial" in scene:  # sideways as well
        for values in scene["initial"].values():
            values[0] = rounded(r.uniform(-0.2, 1) * abs(values[1]))
    scene["probe"] = [
        {"name": "base", "at": [rounded(high[0] / 3, 10), 0.0], "fields": ["u.x", "u.y"]},
        {"name": "flank", "at": [0.0, rounded(high[1] / 3, 10)], "fields": ["u.x", "u.y"]},
    ]
    scene["title"] = f"in a corner, {basis}, {m['law']}, {kind}"
    return Unlike(
        scene,
        ways_of(r, in_time(scene), all_ways, 4),
        moved=moved,
        cell=h,
        above={"base": (1, moved), "flank": (0, 0.0)},
        needed=True,
    )


def plate_that_opens(r, all_ways=False):
    """A plate on a smooth floor, pulled up at one end: a part of it opens, and may do so more than once."""
    basis, nx, ny, h = r.choice(BASES), r.randint(4, 10), r.randint(1, 2), log_uniform(r, 0.05, 5)
    m = material(r, "linear-elastic")
    cells = [nx, ny + 1]
    size, high = [rounded(n * h, 10) for n in cells], [rounded(nx * h, 10), rounded(ny * h, 10)]
    body = {"max": high, "points_per_cell": points_of(r, basis, 2)}
    scene = base_scene(2, size, cells, basis, body, m, "plane-strain")
    g = rounded(log_uniform(r, 1e-6, 1e-3) * m["E"] / (m["rho"] * max(high)))
    scene["body_force"] = {"value": [0.0, -g]}
    scene["support"] = [{"face": "left", "kind": "roller"}]
    scene["wall"] = [{"name": FLOOR, "face": "bottom"}]
    T, weight = wave_time(m, high[0]), m["rho"] * g * high[0] * high[1]
    edge = rounded((nx - 1) * h, 10)
    p = rounded(weight * r.uniform(0.05, 0.45) / h)
    pulled = r.choice([f"{p}", f"{p}*min(t/{rounded(20 * T)}, 1)", f"{p}*(1 + (t<{rounded(15 * T)}))"])
    scene["traction"] = [{"line": [[edge, high[1]], [high[0], high[1]]], "value": [0.0, pulled]}]
    kind = "pulled"
    if r.random() < 0.5:
        kind, _ = disturb(r, scene, m, g, high[1], h, 1, ["thrown", "above", "inside", "later pulse"])
    if "t" in pulled:
        scene["stop"]["time"] = rounded(4000 * T)
    scene["probe"] = [
        {"name": f"at_{k}", "at": [rounded(x * high[0], 10), 0.0], "fields": ["u.x", "u.y"]}
        for k, x in enumerate((0, 0.3, 0.7, 1))
    ]
    scene["title"] = f"a plate that opens, {basis}, {kind}"
    return Unlike(
        scene,
        ways_of(r, in_time(scene), all_ways, 4),
        cell=h,
        above={f"at_{k}": (1, 0.0) for k in range(4)},
        needed=True,
    )


def between_walls(r, all_ways=False):
    """A column between two walls of which the upper one presses it, and may let it go again."""
    basis, nx, ny, h = r.choice(BASES), r.randint(1, 3), r.randint(2, 6), log_uniform(r, 0.05, 5)
    m = material(r, "linear-elastic")
    size = [rounded(nx * h, 10), rounded(ny * h, 10)]
    scene = base_scene(2, size, [nx, ny], basis, {"points_per_cell": points_of(r, basis, 2)}, m, "plane-strain")
    T, strain = wave_time(m, size[1]), log_uniform(r, 1e-6, 1e-2)
    d = rounded(strain * size[1])
    back = r.random() < 0.5
    t1 = rounded(r.uniform(0, 30) * T)
    t2 = rounded(t1 + r.uniform(1, 30) * T)
    scene["support"] = [{"face": "left", "kind": "roller"}, {"face": "right", "kind": "roller"}]
    press = r.choice([f"-{d}*min(t/{rounded(t1 + T)}, 1)", f"-{d}*(t>={t1})", f"-{d}"])
    if back:
        slowly = f"min(t/{rounded(t1 + T)}, 1) - min(max(t/{t2} - 1, 0), 1)"
        press = r.choice([f"-{d}*((t>={t1}) - (t>={t2}))", f"-{d}*({slowly})"])
    scene["wall"] = [{"name": FLOOR, "face": "bottom"}, {"name": "lid", "face": "top", "motion": press}]
    g = rounded(log_uniform(r, 1e-7, 0.5 * strain) * confined_modulus(m) / (m["rho"] * size[1]))
    scene["body_force"] = {"value": [0.0, -g]}
    if "t" in press:
        scene["stop"]["time"] = rounded(4000 * T)
    scene["probe"] = [
        {"name": "base", "at": [rounded(size[0] / 2, 10), 0.0], "fields": ["u.y"]},
        {"name": "top", "at": [rounded(size[0] / 2, 10), size[1]], "fields": ["u.y"]},
    ]
    answer = changed(scene, wall=None)
    answer["support"] += [{"face": "bottom", "kind": "roller"}]
    if not back:
        answer["support"] += [{"face": "top", "kind": "roller", "u": -d}]
    scene["title"] = f"between walls, {basis}, {'pressed and let go' if back else 'pressed'}"
    return Unlike(
        scene,
        ways_of(r, in_time(scene), all_ways, 4),
        answer=answer,
        components=(1,),
        cell=h,
        touching={"base": 0.0} | ({} if back else {"top": -d}),
        needed=True,
    )


def on_wall_in_phases(r, all_ways=False):
    """A column of a large-strain law on a wall, through many phases; the grid follows a wall that moves."""
    basis, nx, ny, h = r.choice(BASES), 2, r.randint(4, 8), log_uniform(r, 0.05, 5)
    m = material(r, r.choice(["hencky", "neo-hookean"]), r.choice([0.0, 0.2, 0.3]))
    cells = [nx, ny + 2]
    size, height = [rounded(n * h, 10) for n in cells], rounded(ny * h, 10)
    body = {"max": [size[0], height], "points_per_cell": points_of(r, basis, 2)}
    scene = base_scene(2, size, cells, basis, body, m, "plane-strain")
    scene["phase"] = {"max_motion": r.choice([0.05, 0.1, 0.3])}
    scene["stop"]["residual"] = 1e-7
    g = rounded(log_uniform(r, 3e-3, 0.2) * confined_modulus(m) / (m["rho"] * height))
    scene["body_force"] = {"value": [0.0, -g]}
    scene["support"] = [{"face": "left", "kind": "roller"}, {"face": "right", "kind": "roller"}]
    scene["wall"] = [{"name": FLOOR, "face": "bottom"}]
    kind, moved = disturb(r, scene, m, g, height, h, 1)
    if "u" in scene.get("initial", {}):
        scene["phase"]["max_motion"] = 0.3  # which has room for it
    if "motion" in scene["wall"][0]:
        scene["grid"]["follow"] = FLOOR
    scene["probe"] = [{"name": "base", "at": [rounded(size[0] / 2, 10), 0.0], "fields": ["u.y"]}]
    answer = changed(scene, wall=None, initial=None, body_force={"value": [0.0, -g]}, phase={"max_motion": "none"})
    answer["grid"].pop("follow", None)
    answer["support"] = [*scene["support"], {"face": "bottom", "kind": "roller", "u": moved}]
    scene["title"] = f"on a wall in phases, {basis}, {m['law']}, {kind}"
    return Unlike(
        scene,
        ways_of(r, in_time(scene), all_ways, 3),
        answer=answer,
        tolerance=IN_PHASES,
        unique=IN_PHASES,
        of_cell=OF_CELL,
        components=(1,),
        moved=moved,
        cell=h,
        notes="cross the cells of a linear basis|out of balance|inertia carried|varies faster",
        needed=True,
    )


ON_WALLS = [column_on_wall, column_on_wall, block_in_corner, plate_that_opens, between_walls, on_wall_in_phases]
