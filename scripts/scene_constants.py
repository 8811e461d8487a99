"""A scene's [constants] as numbers, and formulas of them."""

import math
import tomllib

FUNCTIONS = {name: getattr(math, name) for name in ("sin", "cos", "tan", "asin", "acos", "atan", "sqrt", "exp", "pi")}
FUNCTIONS |= {"ln": math.log, "abs": abs, "min": min, "max": max}


def value_of(formula, names):
    """A number, or a formula of these names as in a scene, with ^ for powers. NameError if one is not known."""
    if not isinstance(formula, str):
        return float(formula)
    return float(eval(formula.replace("^", "**"), {"__builtins__": {}}, FUNCTIONS | names))  # the project's own text


def constants_of(scene, settings):
    """[constants] of a scene, with "constants.name=value" of these settings in their place."""
    with open(scene, "rb") as file:
        formulas = dict(tomllib.load(file).get("constants", {}))
    for setting in settings:
        key, _, value = setting.partition("=")
        if key.startswith("constants."):
            formulas[key.removeprefix("constants.")] = value
    known = {}
    while formulas:
        left = {}
        for name, formula in formulas.items():
            try:
                known[name] = value_of(formula, known)
            except NameError:
                left[name] = formula
        if len(left) == len(formulas):
            raise ValueError(f"{scene}: [constants]: {', '.join(left)}: a formula of what is not known")
        formulas = left
    return known
