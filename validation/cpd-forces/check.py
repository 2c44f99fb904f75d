"""Forces of the peridynamic formulations on clouds of points against the sums as they are printed.

Each point gets a random velocity, so that after one step from rest the displacements are random: a few percent of the
spacing, a fifth with many bonds broken, or so large that half of the tetrahedra are inverted.  The sums (tools/ordered_sums.py)
take displacements from the results and find neighbours, failed bonds and forces by themselves, in extended precision: flat
tetrahedra would cost the doubles of a sum written like this more digits than the program loses.
"""
import dataclasses
import math
import pathlib

import matplotlib.pyplot as plt
import numpy
from tools import deck, ordered_sums, picture
from tools.simulation import Run

HERE = pathlib.Path(__file__).resolve().parent
STEP, CRITICAL, YOUNG = 1e-6, 0.2, 210000.0
CRACK_PLANE, CRACK_END = 2.02, 2.1                      # x of the pre-crack, y of its front


@dataclasses.dataclass(frozen=True)
class Body:
    """What a run is made of; `reach` is the largest displacement in spacings."""

    formulation: str = "cpd"
    dimension: int = 3
    lattice: bool = False
    reach: float = 0.2
    breaks: bool = True
    options: tuple = ()
    ratio: float = 0.25
    seed: int = 1

    @property
    def horizon(self):
        return 2.3 if self.dimension == 3 else 3.2

    @property
    def cells(self):
        return (5, 4, 3) if self.dimension == 3 else (8, 7)


BODIES = {
    "small": Body(reach=0.03, breaks=False),
    "broken": Body(seed=2),
    "inverted": Body(reach=0.8, breaks=False, seed=3),
    "inverted_broken": Body(reach=0.5, seed=4),
    "signed": Body(reach=0.8, breaks=False, options=(("cpd.three_nbr", "signed"),), seed=5),
    "conservative": Body(options=(("cpd.weights", "conservative"),), seed=6),
    "conservative_inverted": Body(reach=0.8, breaks=False, options=(("cpd.weights", "conservative"),), seed=7),
    "lattice": Body(lattice=True, seed=8),
    "lattice_inverted": Body(lattice=True, reach=0.8, breaks=False, seed=9),
    "lattice_sphere": Body(lattice=True, options=(("cpd.hood_volume", "sphere"),), seed=10),
    "lattice_as_cloud": Body(lattice=True, options=(("peridynamics.stencil", "never"),), seed=8),
    "plane": Body(dimension=2, reach=0.3, seed=11),
    "plane_inverted": Body(dimension=2, reach=0.8, breaks=False, seed=12),
    "plane_conservative": Body(dimension=2, reach=0.3, options=(("cpd.weights", "conservative"),), seed=20),
    "plane_lattice": Body(dimension=2, lattice=True, reach=0.3, seed=14),
    "bonds": Body(formulation="bond_pd", seed=15),
    "plane_bonds": Body(formulation="bond_pd", dimension=2, reach=0.3, seed=16),
    "states": Body(formulation="lps", ratio=0.3, seed=17),
    "plane_states": Body(formulation="lps", dimension=2, reach=0.3, ratio=0.3, seed=18),
}


# ---- runs

def points(body):
    """Coordinates (n, 3) and volumes: the middles of cells, moved by up to 0.35 unless they are a lattice."""
    generator = numpy.random.default_rng(body.seed)
    grid = numpy.stack(numpy.meshgrid(*[numpy.arange(n) + 0.5 for n in body.cells], indexing="ij"), -1).reshape(-1, body.dimension)
    volumes = numpy.ones(len(grid))
    if not body.lattice:
        grid = grid + generator.uniform(-0.35, 0.35, grid.shape)
        volumes = generator.uniform(0.7, 1.3, len(grid))
    return numpy.column_stack([grid, numpy.zeros((len(grid), 3 - body.dimension))]), volumes


def moved(body):
    """A zone and a velocity for each point."""
    X, _ = points(body)
    velocities = numpy.random.default_rng(100 + body.seed).uniform(-body.reach, body.reach, X.shape) / STEP
    velocities[:, body.dimension:] = 0
    made = ""
    for number, (place, velocity) in enumerate(zip(X.tolist(), velocities.tolist())):
        made += (f"&zone\n  name = 'p{number}', shape = 'sphere', centre = {deck.written(place)}, radius = 1e-3\n/\n"
                 f"&initial\n  set = 'p{number}', velocity = {deck.written(velocity)}\n/\n")
    return made


def run(name, body):
    text = (HERE / "cloud.nml").read_text(encoding="utf-8")
    changes = {"body.formulation": body.formulation, "peridynamics.horizon": body.horizon, "material.nu": body.ratio} | dict(body.options)
    if body.dimension == 2:
        changes["body.kinematics"] = "plane_strain"
        changes["precrack.shape"], changes["precrack.points"] = "segment", (CRACK_PLANE, -2, CRACK_PLANE, CRACK_END)
        if body.formulation == "cpd":
            changes["cpd.C3"] = 0
    text = deck.vary(text, changes)
    if body.formulation != "cpd":
        text = deck.without(text, "cpd")
    if not body.breaks:
        text = deck.without(deck.without(text, "fracture"), "precrack")
    X, volumes = points(body)
    rows = "".join(",".join(repr(float(value)) for value in row) + "\n" for row in numpy.column_stack([X, volumes]))
    inputs = {"points.csv": "X,Y,Z,volume\n" + rows}
    if body.lattice:
        size = body.cells + (0,) * (3 - body.dimension)
        text = deck.without(text, "points")
        text += (f"\n&lattice\n  type = '{'cubic' if body.dimension == 3 else 'square'}', spacing = 1, size = {deck.written(size)}, "
                 "points = 'centres'\n/\n")
        inputs = {}
    return Run(name, command=(f"{name}.nml",), inputs=inputs | {f"{name}.nml": text + "\n" + moved(body)})


def runs(mode):
    return [run(name, body) for name, body in BODIES.items()]


# ---- the sums

def intact(body, X, x):
    """Bonds that carry: not longer than the critical stretch allows, and not across the pre-crack."""
    if not body.breaks:
        return numpy.ones((len(X), len(X)), bool)
    between = X[None] - X[:, None]
    with numpy.errstate(divide="ignore", invalid="ignore"):
        stretch = ordered_sums.lengths(x[:, None] - x[None]) / ordered_sums.lengths(between) - 1
        share = (CRACK_PLANE - X[:, None, 0]) / between[..., 0]
        across = (share > 0) & (share < 1) & (X[:, None, 1] + share * between[..., 1] < CRACK_END)
    return ~(stretch > CRITICAL) & ~across


def volumes_by_place(body, X):
    """The volumes in the order of the results."""
    places, volumes = points(body)
    return volumes[abs(X[:, None] - places[None]).sum(axis=2).argmin(axis=1)]


def as_printed(body, X, x):
    """The cloud, and its forces by the sums."""
    options, volumes = dict(body.options), volumes_by_place(body, X)
    hoods = None
    if options.get("cpd.hood_volume") == "sphere":
        line = numpy.arange(-3, 4)
        L = ordered_sums.lengths(numpy.stack(numpy.meshgrid(line, line, line), -1).reshape(-1, 3))
        full = ((L > 0) & (L <= body.horizon)).sum()
        distance = ordered_sums.lengths(X[:, None] - X[None])
        hoods = 4 / 3 * math.pi * body.horizon**3 * ((distance > 0) & (distance <= body.horizon)).sum(axis=1) / full
    cloud = ordered_sums.Cloud(X, x, volumes, body.horizon, intact(body, X, x), hoods, options.get("cpd.weights", "paper"),
                               options.get("cpd.three_nbr") == "signed")
    mu = YOUNG / (2 * (1 + body.ratio))
    kappa = 2 * mu * body.ratio / (1 - 2 * body.ratio) + 2 * mu / body.dimension
    if body.formulation == "bond_pd":
        constant = {2: 24 * mu / (math.pi * body.horizon**3), 3: 30 * mu / (math.pi * body.horizon**4)}[body.dimension]
        return cloud, cloud.bond_forces(constant)
    if body.formulation == "lps":
        return cloud, cloud.state_forces(kappa, mu, body.dimension)
    return cloud, sum(cloud.unit_forces(order) for order in range(1, body.dimension + 1))


def inverted(cloud):
    """Part of the tetrahedra (of the triangles in the plane) that are inverted."""
    def volumes(place):
        if numpy.any(cloud.X[:, 2]):
            return numpy.concatenate([cloud.volume(place, i, sets) for i, sets in enumerate(cloud.sets[2])])
        return numpy.concatenate([numpy.cross(*cloud.vectors(place, i, sets))[:, 2] for i, sets in enumerate(cloud.sets[1])])
    return (volumes(cloud.X) * volumes(cloud.x) < 0).mean()


def check(case):
    broken = []
    for name, body in BODIES.items():
        data = case.results[name].exodus
        X, x = (place.astype(numpy.longdouble) for place in (data.points, data.points + data.displacement()))
        cloud, expected = as_printed(body, X, x)
        found = data.vector("internal_force")
        case.figure(f"force_{name}", abs(found - expected).max() / abs(expected).max())
        damage = 1 - (cloud.near & cloud.intact).sum(axis=1) / cloud.near.sum(axis=1)
        broken.append(abs(damage - data.nodal("damage")).max())
        if body.breaks:
            case.figure(f"broken_{name}", 1 - cloud.intact.sum() / cloud.near.sum())
        elif body.formulation == "cpd":
            case.figure(f"inverted_{name}", inverted(cloud))
    case.figure("damage", max(broken))


def pictures(case, folder):
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.8), layout="constrained", width_ratios=(1.3, 1))
    found = {figure.quantity.removeprefix("force_"): figure.value for figure in case.ledger.figures if figure.quantity.startswith("force_")}
    left.barh([name.replace("_", " ") for name in found], list(found.values()), color="#c4173a", left=1e-17)
    left.axvline(1e-12, color="#1d2733", lw=1)
    left.set(xscale="log", xlim=(1e-16, 2e-12), xlabel="largest difference of the forces from the sums as printed")
    left.invert_yaxis()
    left.tick_params(axis="y", labelsize=8)
    name = "inverted_broken"
    data, body = case.results[name].exodus, BODIES[name]
    expected = as_printed(body, data.points, data.points + data.displacement())[1]
    right.plot(expected.ravel(), data.vector("internal_force").ravel(), ".", ms=5, color="#c4173a")
    ends = [expected.min(), expected.max()]
    right.plot(ends, ends, color="#8a98a8", lw=1, zorder=0)
    right.tick_params(labelsize=8)
    right.set(xlabel="force by the sums", ylabel="force of the program", title="inverted tetrahedra and broken bonds")
    picture.save(figure, folder / "figure.png", dpi=120)
    return [("figure.png", "Forces against the sums as printed")]
