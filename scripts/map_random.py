"""Random variations of hard cases: sizes, moduli, laws, bases, points, phases and ways to rest, by a seed.

Variation k of a seed is always the same scene, whatever the number of variations. Each has an answer that is known:
Newton's method on the same points, a slow ramp of the load where they yield, or the closed answer of a column in many
phases.
"""

import random
from pathlib import Path

from map_cases import Row

STEPS = 20_000
RIGHT = ["equilibrium", "noted"]
NAMED = ["step-limit", "time-limit", "diverged", "failed", "refused", "unstable-equilibrium", "no-equilibrium"]

RELAXING = ["viscous"] * 4 + ["auto"] * 4 + ["cundall", "one-sided", "kinetic", "kinetic", "adaptive", "fire", "fire2"]
WITH_OMEGA_1 = ["chebyshev", "nesterov", "papadrakakis", "combined"]
WITH_METHODS = [
    "erk:rk4/viscous", "erk:bogacki-shampine-4-2-3:adaptive/viscous", "erk:jameson-5-2/viscous",
    "symplectic-euler/viscous", "gsl:rkf45:adaptive/viscous", "erk:rk4/kinetic",
]  # fmt: skip
STATIC = ["cg", "lbfgs", "newton-cg"]


def log_uniform(r, low, high):
    return low * (high / low) ** r.random()


def number(value):
    return f"{value:.4g}"


def table(name, **keys):
    """A table of TOML; text that is quoted already, numbers and arrays as they are."""
    lines = [name]
    lines += [f"{key} = {value}" for key, value in keys.items() if value is not None]
    return "\n".join(lines) + "\n"


def quoted(text):
    return f'"{text}"'


def plane_grid(nx, ny, h, basis):
    return "dim = 2\n" + table(
        "[grid]", min="[0.0, 0.0]", max=f"[{h * nx}, {h * ny}]", cells=f"[{nx}, {ny}]", basis=quoted(basis)
    )


def damping():
    """With the stop test."""
    return table("[damping]", strategy=quoted("viscous"), c=quoted("critical")) + table("[stop]", residual=1e-6)


def law(r, name, E, finite):
    nu = r.choice([0.0, 0.2, 0.3, 0.45, 0.499 if not finite else 0.4])
    kind = r.choice(["neo-hookean", "hencky"]) if finite else "linear-elastic"
    rho = log_uniform(r, 1e-2, 1e4)
    return table(f"[material.{name}]", law=quoted(kind), E=number(E), nu=nu, rho=number(rho)), kind, nu, rho


def mass(r):
    return table("[mass]", kind=quoted(r.choice(["lumped", "lumped", "consistent"])))


def points_of(r, basis):
    """Along each coordinate; seldom fewer than the basis asks for."""
    least = {"linear": 1, "quadratic": 2, "cubic": 3, "hermite": 3}[basis]
    return max(1, least + r.choice([-1, 0, 0, 0, 1, 1]))


def bar(r):
    """A bar of one or two materials under forces, in one phase."""
    basis = r.choice(["linear", "quadratic", "cubic", "hermite"])
    cells, h, E = r.randint(2, 40), log_uniform(r, 1e-2, 10), log_uniform(r, 1e-2, 1e9)
    cut = r.choice([0, 0, 0.5, log_uniform(r, 1e-6, 0.5)])  # of the last cell
    length = h * (cells - cut)
    parts = [(0.0, length)] if r.random() < 0.6 or cells < 4 else [(0.0, h * (cells // 2)), (h * (cells // 2), length)]
    text, weight = "", log_uniform(r, 1e-8, 1e-2) * E / length
    for number_, (low, high) in enumerate(parts):
        stiffness = E if number_ == 0 else E * log_uniform(r, 1e-3, 1e4)
        material, _, _, rho = law(r, f"m{number_}", stiffness, False)
        text += material + table(
            "[[body]]", min=low, max=high, material=quoted(f"m{number_}"), points_per_cell=points_of(r, basis),
            volumes=quoted(r.choice(["consistent", "equal"])), placement=quoted(r.choice(["uniform", "gauss"])),
        )  # fmt: skip
    loads = table("[body_force]", value=number(weight / rho))
    if r.random() < 0.4:
        loads = table("[[force]]", at=length, value=number(weight * length))
    if r.random() < 0.2:
        loads += table("[[force]]", at=length / 2, value=number(-weight * length * r.random()))
    supports = table("[[support]]", at=0.0) + (table("[[support]]", at=length) if r.random() < 0.2 and not cut else "")
    grid = table("[grid]", min=0.0, max=h * cells, cells=cells, basis=quoted(basis))
    return grid + text + mass(r) + supports + loads + damping(), "newton"


def stretched_bar(r):
    """A bar at large strain under a dead load, in one phase."""
    basis = r.choice(["linear", "quadratic", "cubic"])
    E, cells = log_uniform(r, 1e-1, 1e8), r.randint(3, 30)
    material, _, _, rho = law(r, "m", E, True)
    text = table("[grid]", min=0.0, max=1.0, cells=cells, basis=quoted(basis)) + material
    text += table(
        "[body]", material=quoted("m"), state=quoted("uniaxial-strain"), points_per_cell=points_of(r, basis) + 1
    )
    text += mass(r) + table("[[support]]", at=0.0)
    if r.random() < 0.5:
        text += table("[[traction]]", face=quoted("right"), value=number(E * r.uniform(-1.0, 1.0)))
    else:
        text += table("[body_force]", value=number(E / rho * r.uniform(-2.0, 0.5)))
    return text + table("[phase]", max_motion=quoted("none")) + damping(), "newton"


def column_in_phases(r):
    """A column at large strain through many phases, on a line or between smooth walls."""
    plane, basis = r.random() < 0.4, r.choice(["quadratic", "cubic", "quadratic", "cubic", "linear"])
    cells, E, l = r.randint(16, 48), log_uniform(r, 1e-1, 1e8), log_uniform(r, 0.1, 100)
    material, kind, nu, rho = law(r, "m", E, True)
    stiffness = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
    g = log_uniform(r, 0.02, 3) * stiffness / (float(number(rho)) * l)
    text = table(
        "[constants]", E=number(E), nu=nu, rho=number(rho), g=number(g), l=number(l), vertical=int(plane)
    )  # for the closed answer
    l = float(number(l))
    points = max(2, points_of(r, basis))
    if plane:
        h = l / cells
        text = plane_grid(2, cells, h, basis) + text
        text += table(
            "[body]", material=quoted("m"), state=quoted("plane-strain"), points_per_cell=f"[{points}, {points}]",
            volumes=quoted("consistent"),
        )  # fmt: skip
        text += table("[[support]]", face=quoted("bottom"))
        text += "".join(table("[[support]]", face=quoted(face), kind=quoted("roller")) for face in ("left", "right"))
        text += f"[body_force]\nvalue = [0.0, {number(-g)}]\n"
    else:
        text += table("[grid]", min=0.0, max=l, cells=cells, basis=quoted(basis))
        text += table(
            "[body]", material=quoted("m"), state=quoted("uniaxial-strain"), points_per_cell=points,
            volumes=quoted("consistent"),
        )  # fmt: skip
        text += table("[[support]]", at=0.0) + table("[body_force]", value=number(-g))
    text += material + table("[mass]", kind=quoted("lumped"))
    transfer = r.choice(["flip", "flip", "apic", "xpic"])
    text += table("[phase]", max_motion=r.choice([0.02, 0.1, 0.1, 0.3, 0.5]), transfer=quoted(transfer))
    return text + damping(), kind.replace("-", "_") + "_column"


def block(r):
    """A block in the plane that hangs, leans or is pulled, in one phase; it may cut its cells."""
    basis, finite = r.choice(["linear", "quadratic", "cubic"]), r.random() < 0.4
    nx, ny, h, E = r.randint(2, 8), r.randint(2, 8), log_uniform(r, 1e-2, 10), log_uniform(r, 1e-1, 1e9)
    cut = r.choice([0.0, 0.0, 0.5, log_uniform(r, 1e-5, 0.3)])
    width, height = h * (nx - cut), h * (ny - cut)
    material, _, _, rho = law(r, "m", E, finite)
    size = log_uniform(r, 1e-4, 0.1 if finite else 1e-2) * E / max(width, height)
    text = plane_grid(nx, ny, h, basis)
    n, placement = points_of(r, basis), r.choice(["uniform", "uniform", "gauss", "random"])
    state = "plane-strain" if finite else r.choice(["plane-strain", "plane-stress", "axisymmetric"])
    text += table(
        "[body]", max=f"[{width}, {height}]", material=quoted("m"), state=quoted(state), points_per_cell=f"[{n}, {n}]",
        volumes=quoted(r.choice(["consistent", "equal"])), placement=quoted(placement), seed=r.randint(1, 999),
        jitter=0.5 if placement == "uniform" and r.random() < 0.3 else None,
    )  # fmt: skip
    text += material + mass(r) + table("[[support]]", face=quoted("bottom"))
    if r.random() < 0.3:
        text += table("[[support]]", face=quoted("left"), kind=quoted("roller"))
    angle = r.choice([[0.0, -1.0], [1.0, 0.0], [0.3, -1.0], [0.0, 1.0]])
    if r.random() < 0.7:
        text += f"[body_force]\nvalue = [{', '.join(number(a * size / rho) for a in angle)}]\n"
    else:
        load = r.choice([f"value = [{number(size * height / 5)}, 0.0]", f"pressure = {number(size * height / 5)}"])
        text += f"[[traction]]\nface = {quoted('top')}\n{load}\n"
    return text + table("[phase]", max_motion=quoted("none")) + damping(), "newton"


def two_blocks(r):
    """A block on another that is softer or stiffer, heavier or lighter."""
    basis, n, h = r.choice(["linear", "quadratic"]), r.randint(2, 5), log_uniform(r, 1e-2, 10)
    E = log_uniform(r, 1e-1, 1e9)
    text = plane_grid(n, 2 * n, h, basis)
    for number_, (low, high) in enumerate([(0.0, h * n), (h * n, 2 * h * n)]):
        material, _, _, rho = law(r, f"m{number_}", E if number_ == 0 else E * log_uniform(r, 1e-5, 1e5), False)
        text += material + table(
            "[[body]]", min=f"[0.0, {low}]", max=f"[{h * n}, {high}]", material=quoted(f"m{number_}"),
            state=quoted("plane-strain"), points_per_cell="[2, 2]", volumes=quoted("consistent"),
        )  # fmt: skip
    g = 1e-4 * E / (rho * h * n)
    text += mass(r) + table("[[support]]", face=quoted("bottom"))
    return text + f"[body_force]\nvalue = [{number(0.2 * g)}, {number(-g)}]\n" + damping(), "newton"


def bodies_in_a_row(r):
    """Several bodies of very different density and stiffness, each on the one before, at small strain or large."""
    n, per, h, E = r.randint(2, 4), r.randint(1, 3), log_uniform(r, 1e-2, 10), log_uniform(r, 1e-1, 1e9)
    finite = r.random() < 0.4
    text, basis = "", r.choice(["linear", "quadratic"])
    for number_ in range(n):
        _, kind, nu, _ = law(r, "m", E, finite)
        rho = log_uniform(r, 1e-3, 1e3)
        text += table(
            f"[material.m{number_}]", law=quoted(kind), E=number(E * log_uniform(r, 1e-4, 1e4)), nu=nu, rho=number(rho)
        )
        text += table(
            "[[body]]", min=f"[0.0, {h * per * number_}]", max=f"[{2 * h}, {h * per * (number_ + 1)}]",
            material=quoted(f"m{number_}"), state=quoted("plane-strain"), points_per_cell="[3, 3]",
        )  # fmt: skip
        size = log_uniform(r, 1e-8, 1e-3) * E * h
        text += f"[[force]]\nat = [{h}, {h * per * (number_ + 1)}]\nvalue = [{number(size * r.uniform(-1, 1))}, {number(-size)}]\n"
    text = plane_grid(2, n * per, h, basis) + text + mass(r) + table("[[support]]", face=quoted("bottom"))
    return text + table("[phase]", max_motion=quoted("none")) + damping(), "newton"


def moved_support(r):
    """A block whose top or side is moved, with no load or a small one."""
    basis, finite = r.choice(["linear", "quadratic"]), r.random() < 0.5
    nx, ny, h, E = r.randint(2, 6), r.randint(2, 6), log_uniform(r, 1e-2, 10), log_uniform(r, 1e-1, 1e9)
    material, _, _, rho = law(r, "m", E, finite)
    n = points_of(r, basis) + 1
    text = plane_grid(nx, ny, h, basis) + table(
        "[body]", material=quoted("m"), state=quoted("plane-strain"), points_per_cell=f"[{n}, {n}]"
    )
    text += material + mass(r) + table("[[support]]", face=quoted("bottom"))
    u = h * r.choice([-1, 1]) * log_uniform(r, 1e-4, 0.5 if finite else 1e-2)
    moved = quoted(number(u) if r.random() < 0.5 else f"{number(u)}*min(t, 1)")
    kind = r.choice(["fixed", "roller"])
    text += table("[[support]]", face=quoted(r.choice(["top", "top", "left"])), kind=quoted(kind), u=moved)
    if r.random() < 0.5:
        g = number(-log_uniform(r, 1e-6, 1e-3) * E / (rho * h))
        text += f"[body_force]\nvalue = [0.0, {g}]\n"
    time = "" if "min" not in moved else "time = 1e6\n"  # the loads at the end, for who takes them there
    return text + table("[phase]", max_motion=quoted("none")) + damping() + time, "newton"


def pinned_shape(r):
    """A polygon that cuts its cells, on a pinned corner and a roller, under a point force, a traction or its weight."""
    basis, n, h, E = r.choice(["linear", "quadratic"]), r.randint(3, 8), log_uniform(r, 1e-2, 10), log_uniform(r, 1, 1e9)
    material, _, _, rho = law(r, "m", E, False)
    h = float(number(h))
    l, top = h * n, h * n * r.uniform(0.55, 0.95)
    corners = r.choice([
        [[0, 0], [l, 0], [l, top], [0, l]],
        [[0, 0], [l, 0], [l, l / 2], [l / 2, l / 2], [l / 2, l], [0, l]],
        [[0, 0], [l, 0], [top, l], [l - top, l]],
    ])  # fmt: skip
    text = plane_grid(n, n, h, basis) + table(
        "[body]", polygon=str(corners), material=quoted("m"),
        state=quoted(r.choice(["plane-strain", "plane-stress"])), points_per_cell="[3, 3]",
    )  # fmt: skip
    text += material + mass(r)
    if r.random() < 0.5:
        text += table("[[support]]", face=quoted("bottom"), kind=quoted("roller"))
        text += table("[[support]]", at="[0.0, 0.0]", component=0)
    else:
        text += table("[[support]]", face=quoted("bottom"))
    size = log_uniform(r, 1e-6, 1e-3) * E
    if r.random() < 0.5:
        text += f"[[force]]\nat = [{number(0.49 * l)}, {number(0.49 * l)}]\nvalue = [{number(size * h)}, {number(-size * h)}]\n"
    else:
        text += f"[body_force]\nvalue = [{number(0.3 * size / (rho * l))}, {number(-size / (rho * l))}]\n"
    return text + damping(), "newton"


def two_materials_at_large_strain(r):
    """A soft bar and a stiff one, with forces on the stiff one that nearly balance."""
    cells, E = r.choice([6, 10, 16]), log_uniform(r, 1e-1, 1e6)
    contrast, kind, half = log_uniform(r, 10, 1e6), r.choice(["neo-hookean", "hencky"]), cells // 2
    text = table("[grid]", min=0.0, max=cells, cells=cells, basis=quoted(r.choice(["linear", "quadratic"])))
    for number_, (low, high, stiffness) in enumerate([(0, half, E), (half, cells, E * contrast)]):
        rho = log_uniform(r, 1e-2, 1e2)
        text += table(f"[material.m{number_}]", law=quoted(kind), E=number(stiffness), nu=0.2, rho=number(rho))
        text += table(
            "[[body]]", min=low, max=high, material=quoted(f"m{number_}"), state=quoted("uniaxial-strain"),
            points_per_cell=4,
        )  # fmt: skip
    large = E * contrast * log_uniform(r, 1e-3, 0.3)
    for at, value in ((half + 1, large), (cells - 1, -large), (cells, E * r.uniform(-0.5, 0.5))):
        text += table("[[force]]", at=at, value=number(value))
    return text + mass(r) + table("[[support]]", at=0.0) + table("[phase]", max_motion=quoted("none")) + damping(), "newton"


def yielding_column(r):
    """Ground that yields under its weight or a load, in one phase; a slow ramp of the load is the answer."""
    n, h, E, phi = r.randint(3, 8), log_uniform(r, 0.1, 2), log_uniform(r, 1e6, 1e9), r.choice([0, 10, 20, 30])
    rho, nu = log_uniform(r, 1e2, 1e4), r.choice([0.2, 0.3, 0.4])
    load = E * log_uniform(r, 1e-4, 3e-3)
    text = plane_grid(n, n, h, r.choice(["linear", "quadratic"]))
    text += table(
        "[material.m]", law=quoted("drucker-prager"), E=number(E), nu=nu, rho=number(rho), phi=phi,
        psi=r.choice([0, phi]), c=number(load * r.uniform(0.05, 0.6)),
    )  # fmt: skip
    text += table("[body]", material=quoted("m"), state=quoted("plane-strain"), points_per_cell="[3, 3]")
    text += mass(r) + table("[[support]]", face=quoted("bottom"))
    text += "".join(table("[[support]]", face=quoted(face), kind=quoted("roller")) for face in ("left", "right"))
    force = [0.0 if r.random() < 0.5 else 0.3 * load, -load]
    share = 1 if r.random() < 0.5 else 1 / (rho * n * h)  # a traction, or a weight
    key, head = ("traction[0].value", '[[traction]]\nface = "top"') if share == 1 else ("body_force.value", "[body_force]")
    values = [number(component * share) for component in force]
    text += f"{head}\nvalue = [{', '.join(values)}]\n"
    rise = 500 * n * h * (rho / E) ** 0.5  # dozens of its longest periods
    slow = ", ".join(f"'{value}*min(t/{rise:.4g}, 1)'" for value in values)
    judge_settings = [f"{key}=[{slow}]", f"stop.time={1.5 * rise:.4g}"]
    return text + table("[phase]", max_motion=quoted("none")) + damping(), "slow", *judge_settings


FAMILIES = [
    bar, bar, stretched_bar, column_in_phases, column_in_phases, block, block, two_blocks, bodies_in_a_row,
    moved_support, pinned_shape, two_materials_at_large_strain, yielding_column,
]  # fmt: skip


def way_of(r):
    kind = r.random()
    if kind < 0.6:
        return r.choice(RELAXING)
    return r.choice(WITH_OMEGA_1 if kind < 0.72 else WITH_METHODS if kind < 0.86 else STATIC)


def variation(seed, k, folder):
    """Row k, with its scene written into the folder."""
    r = random.Random(f"{seed} {k}")
    family = r.choice(FAMILIES)
    text, judge, *judge_settings = family(r)
    way = way_of(r)
    if judge.endswith("_column") and way in STATIC:
        way = "auto"  # a static solver has one phase
    scene = Path(folder) / f"{seed}-{k}.toml"
    scene.write_text(f'title = "Variation {k} of seed {seed}: {family.__name__}"\n{text}', encoding="utf-8")
    return Row(
        case=f"{family.__name__} {k}",
        way=way,
        scene=scene,
        settings=[f"stop.steps={STEPS}"],
        judge_settings=judge_settings,
        expected=[*RIGHT, *NAMED, "not judged"],
        judge=judge,
        notes="cross the cells of a linear basis|K is singular|inertia carried|out of balance",
        seconds=10,
    )
