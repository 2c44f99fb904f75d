"""Reads what a run wrote: Exodus II results, the history, the table of broken bonds, printed tables.  Nothing else."""
import csv
import functools

import netCDF4
import numpy


def _texts(variable):
    return [str(row) for row in netCDF4.chartostring(variable[:]).reshape(-1)]


class Exodus:
    """Nodes, simplices and frames of an Exodus II file."""

    def __init__(self, path):
        self.file = netCDF4.Dataset(path)
        self.file.set_auto_mask(False)
        self.path = str(path)
        self.points = self._triples([f"coord{axis}" for axis in "xyz"], self.file.variables, lambda name: self.file[name][:])
        self.times = self.file["time_whole"][:].astype(float)
        self.blocks = len(self.file.dimensions["num_el_blk"])
        self.nodal_names = self._names("name_nod_var")
        self.element_names = self._names("name_elem_var")

    def _names(self, name):
        return [text.strip() for text in _texts(self.file[name])] if name in self.file.variables else []

    def _position(self, names, name):
        lowered = [entry.lower() for entry in names]
        if name.lower() not in lowered:
            raise KeyError(f"{self.path} has no '{name}'; it has {', '.join(names)}")
        return lowered.index(name.lower()) + 1

    def _triples(self, names, known, read):
        """Three columns; components that a plane result does not carry are zero."""
        present = [read(name) if name in known else None for name in names]
        return numpy.column_stack([numpy.zeros_like(present[0]) if column is None else column for column in present])

    @property
    def is_plane(self):
        return self.simplices.shape[1] == 3

    @functools.cached_property
    def simplices(self):
        """0-based corners of the elements of all blocks."""
        return numpy.concatenate([self.file[f"connect{block}"][:] for block in range(1, self.blocks + 1)]).astype(int) - 1

    def nodal(self, name, step=-1):
        return self.file[f"vals_nod_var{self._position(self.nodal_names, name)}"][step].astype(float)

    def element(self, name, step=-1):
        index = self._position(self.element_names, name)
        return numpy.concatenate([self.file[f"vals_elem_var{index}eb{block}"][step] for block in range(1, self.blocks + 1)])

    def vector(self, name, step=-1):
        """A nodal vector (n, 3) written as name_x, name_y, name_z."""
        return self._triples([f"{name}_{axis}" for axis in "xyz"], self.nodal_names, lambda column: self.nodal(column, step))

    def displacement(self, step=-1):
        return self._triples([f"DISPL{axis}" for axis in "XYZ"], self.nodal_names, lambda column: self.nodal(column, step))

    def alive(self, step=-1):
        """True for simplices that carry load."""
        if "status" not in [name.lower() for name in self.element_names]:
            return numpy.ones(len(self.simplices), bool)
        return self.element("status", step) > 0.5


def read_table(path):
    """Columns of a history or event table as arrays by name."""
    with netCDF4.Dataset(path) as file:
        file.set_auto_mask(False)
        return {name: numpy.asarray(variable[:]) for name, variable in file.variables.items()}


def read_csv(path):
    """Columns of a CSV that cleave printed as arrays by name; the unit after the name is cut off."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    names = [name.split(" [")[0] for name in rows[0]]
    return dict(zip(names, numpy.array(rows[1:], float).T))
