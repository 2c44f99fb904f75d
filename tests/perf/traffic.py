"""What a step of the Continuum Bond Method must move between memory and a core, in bytes per particle: a model, not a
measurement. It follows the blocks of kernels/src/formulation/cbm/block_step.hpp: what a block has read once in a pass stays
in the core's cache until the pass over the block ends. Reads and writes count once each, as STREAM counts its triad: the
read that a processor does before it writes a line is left out on both sides. Change it with the layout.
"""
REAL, SINGLE, INDEX, LOCAL = 8, 4, 4, 2  # bytes of a double, a float, an index, a particle's number inside a block

BLOCK = 2048  # particles of a block
# For bonds to the corners of lattice tetrahedra and triangles (14 and 6 a particle), blocks being cubes and squares:
CUT = {3: 0.130, 2: 0.029}      # share of bonds cut by a face of a block, which are stored once from each end
FOREIGN = {3: 0.50, 2: 0.09}    # particles of other blocks at the end of a bond, per particle of the block

HISTORY = {"svk": 0, "neo_hooke": 0, "linear_elastic": 0}  # doubles of a particle; plasticity:
PLASTIC_HISTORY = 8


def words_of(case):
    law, *rest = case.split("+")
    return law, set(rest)


def passes(case, dimension, half_bonds):
    """[(what, bytes per particle)] of a step. half_bonds: of a particle, as the mesh has them."""
    law, words = words_of(case)
    vector = REAL * dimension
    stored = 0.5 * half_bonds * (1 + CUT[dimension])  # bonds in the rows of a particle of a block
    foreign = FOREIGN[dimension]
    forces = 2 if "viscosity" in words else 1  # internal, viscous
    history = REAL * HISTORY.get(law, PLASTIC_HISTORY)
    lines = [
        ("advance: v read and written", 2 * vector),
        ("advance: u read and written", 2 * vector),
        ("advance: forces, 1/m, driven or not", forces * vector + REAL + 1),
        ("update: u of own and foreign particles", (1 + foreign) * vector),
        ("update: rows of bonds: vector and end", stored * (vector + LOCAL)),
        ("update: begin of the rows of both kinds, volume", 2 * INDEX + REAL),
        ("update: history read and written", 2 * history),
        ("update: forces of own particles", forces * vector),
        ("update: forces of foreign particles to slots and back", 2 * foreign * forces * vector),
        ("update: slot numbers", foreign * INDEX),
        ("update: v read and written, 1/m", 2 * vector + REAL),
    ]
    if "viscosity" in words:
        lines += [("viscosity: weights of bonds", stored * REAL),
                  ("viscosity: v and X of own and foreign particles", (2 * foreign + 1) * vector + vector)]
    if "search" in words:
        lines += [("search: X and u of own and foreign particles", 2 * (1 + foreign) * vector),
                  ("search: end and limit of bonds", stored * (LOCAL + SINGLE))]
    return lines


def bytes_per_step(case, dimension, half_bonds):
    return sum(amount for _, amount in passes(case, dimension, half_bonds))
