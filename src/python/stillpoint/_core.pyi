"""The compiled half of the package: the library itself."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

Told = Optional[Callable[[dict[str, Any]], Any]]

class Scene:
    """One problem as it was read, checked and completed; load() makes it."""

    @property
    def name(self) -> str:
        """The file's stem."""
    @property
    def title(self) -> str:
        """Of the scene; empty if it has none."""
    @property
    def dim(self) -> int:
        """1, 2 or 3."""
    @property
    def text(self) -> str:
        """As TOML, without the overrides."""
    @property
    def overrides(self) -> list[str]:
        """What was laid over it, "key=value" each."""
    @property
    def file(self) -> str:
        """Where it was read from; of a dictionary, scene.toml in the folder where the files that it names are looked for."""

class Simulation:
    """What stillpoint.Simulation is made of."""

    def __init__(
        self,
        scene: Scene,
        *,
        out: str = ...,
        resume: str = ...,
        threads: int = ...,
        stop: Optional[Callable[[Any], bool | str]] = ...,
        progress: Told = ...,
    ) -> None: ...
    def step(self, until: float = ...) -> bool:
        """One accepted step, not past time until [s], with the change of phase that it calls for; nothing once done.
        Returns whether the simulation goes on."""
    def run(self, until: float = ...) -> object:
        """Steps until time until [s], or until it is done."""
    def save(self, checkpoint: str) -> None:
        """Saves the state between two steps, to go on from with resume(). OSError if the file cannot be written."""
    def summary_json(self) -> str:
        """The text of summary.json, as of now."""
    def history_rows(self) -> tuple[list[str], NDArray[np.float64]]:
        """The names of the columns of the history, and its rows so far, (rows × columns)."""
    @property
    def done(self) -> bool:
        """Whether it has ended: at rest, at a limit, or as something went wrong."""
    @property
    def status(self) -> str:
        """"running", "equilibrium", "stop-test", "end-time", …, as in summary.json."""
    @property
    def reason(self) -> str:
        """The inequality that ended it, or what went wrong."""
    @property
    def t(self) -> float:
        """The time reached [s]."""
    @property
    def steps(self) -> int:
        """Accepted steps so far."""
    @property
    def evaluations(self) -> int:
        """Evaluations of the internal force so far."""
    @property
    def phases(self) -> int:
        """Phases that have begun."""
    @property
    def residual(self) -> float:
        """The norm of F - R over that of F, at present."""
    @property
    def distance(self) -> Optional[float]:
        """The bound of the distance from equilibrium, relative; None if there is none."""
    @property
    def points(self) -> Points:
        """The material points."""
    @property
    def unknowns(self) -> Unknowns:
        """The free degrees of freedom of the present phase."""

class Unknowns:
    """The n free degrees of freedom of the grid, in the present phase."""

    @property
    def size(self) -> int:
        """n, their number."""
    def __len__(self) -> int: ...
    @property
    def u(self) -> NDArray[np.float64]:
        """Displacement since the phase began, (n) [m]: a read-only view of the state itself, which steps change. A new
        phase has unknowns of its own: the array of an old one stays as it was at the end of that."""
    @property
    def v(self) -> NDArray[np.float64]:
        """Velocity, (n) [m/s]: likewise; with mass.kind = "multigrid" a copy of now."""
    def residual(self, u: Optional[ArrayLike] = ..., t: Optional[float] = ...) -> NDArray[np.float64]:
        """F - R(u), (n) [N], at time t [s]; None: of the present. Changes nothing in the simulation. ValueError if u
        cannot be evaluated, or if walls touch the body."""
    def internal_force(self, u: Optional[ArrayLike] = ..., t: Optional[float] = ...) -> NDArray[np.float64]:
        """R(u), likewise."""
    def external_force(self, u: Optional[ArrayLike] = ..., t: Optional[float] = ...) -> NDArray[np.float64]:
        """F(t, u), likewise."""
    def tangent(self, u: Optional[ArrayLike] = ..., t: Optional[float] = ..., elastic: bool = ...) -> Any:
        """K = dR/du, likewise, as scipy.sparse.csc_matrix (n × n) [N/m]; elastic: as if no point yielded, symmetric. Loads
        that follow u have a derivative of their own, which is no part of it."""
    def mass_matrix(self) -> Any:
        """M as scipy.sparse.csc_matrix (n × n) [kg]. ValueError with mass.kind = "multigrid", of which the inverse alone
        is known."""
    def mass_product(self, x: ArrayLike) -> NDArray[np.float64]:
        """M x; x: (n)."""
    def mass_solve(self, b: ArrayLike) -> NDArray[np.float64]:
        """The x of M x = b; b: (n)."""

class Points:
    """The P material points, in the order in which the body was filled. Each field is an array of its own, read as of the
    call: the points are stored in blocks, by cell, and what depends on u is computed. (P), or (P × components); in one
    dimension (P)."""

    def __len__(self) -> int: ...
    @property
    def position(self) -> NDArray[np.float64]:
        """(P × dim) [m]"""
    @property
    def initial_position(self) -> NDArray[np.float64]:
        """When the run began, (P × dim) [m]."""
    @property
    def displacement(self) -> NDArray[np.float64]:
        """Since the run began, (P × dim) [m]."""
    @property
    def velocity(self) -> NDArray[np.float64]:
        """(P × dim) [m/s]"""
    @property
    def strain(self) -> NDArray[np.float64]:
        """The gradient of the displacement since the phase began, (P × components)."""
    @property
    def stress(self) -> NDArray[np.float64]:
        """Cauchy's, (P × components) [Pa]: xx, yy, zz, xy in the plane, then yz, zx in space."""
    @property
    def volume(self) -> NDArray[np.float64]:
        """(P) [m³]"""
    @property
    def mass(self) -> NDArray[np.float64]:
        """(P) [kg]"""
    def __getattr__(self, name: str) -> NDArray[np.float64]:
        """What laws remember, such as plastic_strain, (P). AttributeError names the fields that there are."""

class Motion:
    """The state that a relaxation steps from, during the call that it is given to. The arrays are read-only copies that
    the next call fills again: copy what is to be kept."""

    @property
    def t(self) -> float:
        """The pseudo-time [s]."""
    @property
    def last_step(self) -> float:
        """Of the step before [s]; 0: there is none since the phase began."""
    @property
    def max_step(self) -> float:
        """The step given, a share of the critical one [s]."""
    @property
    def omega_1(self) -> float:
        """[rad/s]; 0 unless needs_omega_1."""
    @property
    def u(self) -> NDArray[np.float64]:
        """Displacement since the phase began, (n) [m]."""
    @property
    def v(self) -> NDArray[np.float64]:
        """Velocity, (n) [m/s]."""
    @property
    def Q(self) -> NDArray[np.float64]:
        """Out-of-balance force F - R(u), (n) [N]."""
    @property
    def a(self) -> NDArray[np.float64]:
        """The a of M a = Q, (n) [m/s²]."""
    def mass_product(self, x: ArrayLike) -> NDArray[np.float64]:
        """M x; x: (n)."""

def add_damping(
    name: str,
    force: Callable[[NDArray[np.float64], NDArray[np.float64], float], ArrayLike],
    *,
    stiffness_factor: float = ...,
    equation: str = ...,
    source: str = ...,
) -> None: ...
def add_load(
    name: str,
    force: Callable[[float, NDArray[np.float64]], ArrayLike],
    *,
    settles_at: float = ...,
) -> None: ...
def add_relaxation(
    name: str,
    make: Callable[[], Any],
    *,
    equation: str = ...,
    source: str = ...,
    needs_omega_1: bool = ...,
) -> None: ...
def add_history_law(
    name: str,
    answer: Callable[..., Any],
    elastic: Callable[..., Any],
    moduli: Callable[..., Any] | None,
    *,
    parameters: Mapping[str, float | None],
    history: Sequence[str],
    equation: str,
    source: str,
) -> None: ...
def load_file(file: str, overrides: Sequence[str]) -> Scene: ...
def load_text(file: str, text: str, overrides: Sequence[str]) -> Scene: ...
def load_again(scene: Scene, overrides: Sequence[str]) -> Scene: ...
def load_checkpoint(checkpoint: str) -> Scene: ...
def run(scene: Scene, *, out: str, threads: int, progress: Told) -> str: ...
def compare(
    scene: Scene,
    *,
    out: str,
    progress: Told,
    integrators: Sequence[str],
    strategies: Sequence[str],
    step_fractions: Sequence[float],
    tolerances: Sequence[float],
    goal: float,
    limit: float,
    seconds: float,
    repeats: int,
    seed: int,
    overshoot: bool,
    threads: int,
) -> str: ...
def converge(
    scenes: Sequence[Scene],
    *,
    varied: Sequence[Sequence[str]],
    out: str,
    progress: Told,
    refine: Sequence[str],
    levels: int,
    ratio: float,
    dominant: bool,
    threads: int,
) -> str: ...
def safety(
    scene: Scene, *, out: str, progress: Told, first: float, last: float, width: float, threads: int
) -> str: ...
def settings_of_series(vary: Sequence[str]) -> list[list[str]]: ...
def spectrum(scene: Scene) -> dict[str, Any]: ...
