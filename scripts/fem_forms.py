"""What FEniCSx is given of each case: loads as forms, the law, the supports."""

import dolfinx
import numpy as np
import ufl
from beside_fem_plane import BEAM_DEPTH, BEAM_LENGTH, BEAM_LOAD, COOK_LOAD, INNER, PRESSURE
from beside_fem_space import CUBE_AMPLITUDES, SPHERE_INNER, SPHERE_PRESSURE
from kirsch_plate import HOLE, SIDE, TENSION
from petsc4py import PETSc


def small_stress(u, law):
    lam, mu = law.lame
    strain = ufl.sym(ufl.grad(u))
    return lam * ufl.tr(strain) * ufl.Identity(len(u)) + 2 * mu * strain


def large_work(u, law, dx):
    """∫ W with W = μ/2 (tr C − 2 − 2 ln J) + λ/2 (ln J)², in plane strain"""
    lam, mu = law.lame
    F = ufl.Identity(2) + ufl.grad(u)
    log_J = ufl.ln(ufl.det(F))
    return (mu / 2 * (ufl.tr(F.T * F) - 2 - 2 * log_J) + lam / 2 * log_J**2) * dx


def vortex_load(x, law):
    """ρ b of problems/ladder/vortex_disc.toml"""
    A, w, n, mu = 1.0, 1.5, 4, law.lame[1]
    R2 = ufl.dot(x, x)
    q = 1 - R2 / w**2
    angle = A * q**n
    a = -2 * n * A * q ** (n - 1) / w**2
    b = 4 * n * (n - 1) * A * q ** (n - 2) / w**4
    outwards = ufl.as_vector([x[0] * ufl.cos(angle) - x[1] * ufl.sin(angle), x[0] * ufl.sin(angle) + x[1] * ufl.cos(angle)])
    around = ufl.as_vector([-outwards[1], outwards[0]])
    load = mu * R2 * a**2 * outwards - mu * (4 * a + R2 * b) * around
    return ufl.conditional(ufl.gt(q, 0), 1.0, 0.0) * load


def cube_load(x, law):
    """ρ b of problems/ladder/mms_cube.toml"""
    lam, mu = law.lame
    s, c = [ufl.sin(ufl.pi * xi) for xi in x], [ufl.cos(ufl.pi * xi) for xi in x]
    total = float(CUBE_AMPLITUDES.sum())
    return ufl.as_vector([
        ufl.pi**2 * (3 * mu * float(A) + (lam + mu) * total) * s[i] * c[i - 2] * c[i - 1]
        for i, A in enumerate(CUBE_AMPLITUDES)
    ])  # fmt: skip


def vortex_work(case, mesh, v, degree):
    return ufl.inner(vortex_load(ufl.SpatialCoordinate(mesh), case.law), v) * ufl.dx(metadata={"quadrature_degree": degree})


def cube_work(case, mesh, v, degree):
    return ufl.inner(cube_load(ufl.SpatialCoordinate(mesh), case.law), v) * ufl.dx(metadata={"quadrature_degree": degree})


def ring_work(case, mesh, v, degree):
    inside = on_facets(mesh, lambda x: np.hypot(x[0], x[1]) < INNER * (1 + 1e-6), degree)
    return -PRESSURE * ufl.inner(ufl.FacetNormal(mesh), v) * inside


def plate_work(case, mesh, v, degree):
    """σ·n on the sides away from the hole, by problems/ladder/kirsch.toml"""
    x = ufl.SpatialCoordinate(mesh)
    q2, angle = HOLE**2 / ufl.dot(x, x), ufl.atan_2(x[1], x[0])
    c2, c4, s2, s4 = ufl.cos(2 * angle), ufl.cos(4 * angle), ufl.sin(2 * angle), ufl.sin(4 * angle)
    xx = 1 - q2 * (1.5 * c2 + c4) + 1.5 * q2**2 * c4
    yy = -q2 * (0.5 * c2 - c4) - 1.5 * q2**2 * c4
    xy = -q2 * (0.5 * s2 + s4) + 1.5 * q2**2 * s4
    sides = on_facets(mesh, lambda x: np.isclose(x[:2].max(axis=0), SIDE), degree)
    return TENSION * ufl.inner(ufl.as_matrix([[xx, xy], [xy, yy]]) * ufl.FacetNormal(mesh), v) * sides


def sphere_work(case, mesh, v, degree):
    inside = on_facets(mesh, lambda x: np.sqrt((x**2).sum(axis=0)) < SPHERE_INNER * (1 + 1e-6), degree)
    return -SPHERE_PRESSURE * ufl.inner(ufl.FacetNormal(mesh), v) * inside


def no_work(_case, mesh, v, _degree):
    return ufl.inner(dolfinx.fem.Constant(mesh, np.zeros(mesh.geometry.dim)), v) * ufl.dx


def cook_work(case, mesh, v, degree):
    return COOK_LOAD * v[1] * on_facets(mesh, lambda x: np.isclose(x[0], 48), degree)


def elastica_work(case, mesh, v, degree):
    return -BEAM_LOAD / BEAM_DEPTH * v[1] * on_facets(mesh, lambda x: np.isclose(x[0], BEAM_LENGTH), degree)


# The loads' virtual work by case.
WORK_OF_LOADS = {
    "vortex": vortex_work,
    "lame": ring_work,
    "kirsch": plate_work,
    "cook": cook_work,
    "cook_incompressible": cook_work,
    "elastica": elastica_work,
    "cube": cube_work,
    "torsion": no_work,
    "sphere": sphere_work,
}


def on_facets(mesh, marker, degree):
    """The measure of the facets on the border whose corners are marked."""
    facets = dolfinx.mesh.locate_entities_boundary(mesh, mesh.topology.dim - 1, marker)
    tags = dolfinx.mesh.meshtags(mesh, mesh.topology.dim - 1, np.sort(facets), np.ones(len(facets), dtype=np.int32))
    return ufl.Measure("ds", domain=mesh, subdomain_data=tags, metadata={"quadrature_degree": degree})(1)


def large_stress(u, law):
    """σ = (μ (F Fᵀ − I) + λ ln J I)/J, and σ_zz"""
    lam, mu = law.lame
    F = ufl.Identity(2) + ufl.grad(u)
    J = ufl.det(F)
    through = lam * ufl.ln(J) / J
    return mu / J * (F * F.T - ufl.Identity(2)) + through * ufl.Identity(2), through


def supports_of(supports, V, W=None):
    """Dirichlet conditions on components of u; W: of u and a pressure."""
    mesh, side, conditions = V.mesh, V.mesh.topology.dim - 1, []
    for support in supports:
        facets = dolfinx.mesh.locate_entities_boundary(mesh, side, lambda x: np.isclose(x[support.axis], support.at))
        for number, component in enumerate(support.components):
            of_component = (V if W is None else W.sub(0)).sub(component)
            if support.value is None:
                dofs = dolfinx.fem.locate_dofs_topological(of_component, side, facets)
                conditions.append(dolfinx.fem.dirichletbc(PETSc.ScalarType(0), dofs, of_component))
            else:
                conditions.append(held_at(support, number, of_component, facets))
    return conditions


def held_at(support, number, of_component, facets):
    """The condition that a component is what the support's value says."""
    alone, _ = of_component.collapse()
    dofs = dolfinx.fem.locate_dofs_topological((of_component, alone), alone.mesh.topology.dim - 1, facets)
    value, x = dolfinx.fem.Function(alone), alone.tabulate_dof_coordinates()[dofs[1]]
    value.x.array[dofs[1]] = support.value(x[:, : alone.mesh.geometry.dim])[:, number]
    return dolfinx.fem.dirichletbc(value, dofs, of_component)
