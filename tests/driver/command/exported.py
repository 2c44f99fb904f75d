"""Exported files and results in the eyes of other programs: csv, netCDF4, VTK."""

import csv
import io

import netCDF4
import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy


def write_exodus(path, points, blocks, nodal, element):
    """A result as Exodus II defines it, written without Cleave. blocks: (name, type, nodes from 1);
    nodal, element: {name: values}."""
    with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_DATA") as file:
        file.title = "by hand"
        for name, length in (("len_name", 33), ("time_step", None), ("num_dim", 3),
                             ("num_nodes", len(points)), ("num_el_blk", len(blocks)),
                             ("num_elem", sum(len(nodes) for _, _, nodes in blocks)),
                             ("num_nod_var", len(nodal)), ("num_elem_var", len(element))):
            if length != 0:  # Exodus leaves out what is empty
                file.createDimension(name, length)
        times = file.createVariable("time_whole", "f8", ("time_step",))
        for axis, values in zip("xyz", numpy.transpose(points)):
            file.createVariable("coord" + axis, "f8", ("num_nodes",))[:] = values
        for variable, dimension, names in (("eb_names", "num_el_blk", [name for name, _, _ in blocks]),
                                           ("name_nod_var", "num_nod_var", nodal),
                                           ("name_elem_var", "num_elem_var", element)):
            if names:
                file.createVariable(variable, "S1", (dimension, "len_name"))[:] = \
                    numpy.array([list(name.ljust(33, "\0")) for name in names], "S1")
        first = 0
        for b, (_, kind, nodes) in enumerate(blocks, start=1):
            file.createDimension(f"num_el_in_blk{b}", len(nodes))
            file.createDimension(f"num_nod_per_el{b}", len(nodes[0]))
            shape = (f"num_el_in_blk{b}", f"num_nod_per_el{b}")
            connect = file.createVariable(f"connect{b}", "i4", shape)
            connect[:] = nodes
            connect.elem_type = kind
            for v, values in enumerate(element.values(), start=1):
                file.createVariable(f"vals_elem_var{v}eb{b}", "f8", ("time_step", shape[0]))[0, :] = \
                    values[first:first + len(nodes)]
            first += len(nodes)
        for v, values in enumerate(nodal.values(), start=1):
            file.createVariable(f"vals_nod_var{v}", "f8", ("time_step", "num_nodes"))[0, :] = values
        times[:] = [0.25]


class Result:
    """One frame of a result in netCDF4's eyes: arrays by the names in the file."""

    def __init__(self, path, frame):
        with netCDF4.Dataset(path) as file:
            def rows(name):
                return [row.tobytes().split(b"\0")[0].decode() for row in file[name][:].filled(b"\0")]
            self.times = file["time_whole"][:].filled()
            self.X = numpy.transpose([file["coord" + axis][:].filled() for axis in "xyz"])
            self.ids = file["node_num_map"][:].filled() if "node_num_map" in file.variables else None
            self.nodal = {name: file[f"vals_nod_var{v}"][frame].filled()
                          for v, name in enumerate(rows("name_nod_var"), start=1)}
            self.units = {name: getattr(file[f"vals_nod_var{v}"], "units", "")
                          for v, name in enumerate(rows("name_nod_var"), start=1)}
            self.blocks = rows("eb_names")
            self.nodes = [file[f"connect{b + 1}"][:].filled() - 1 for b in range(len(self.blocks))]
            self.element = {name: numpy.concatenate([file[f"vals_elem_var{v}eb{b + 1}"][frame].filled()
                                                     for b in range(len(self.blocks))])
                            for v, name in enumerate(rows("name_elem_var"), start=1)}
        self.u = numpy.transpose([self.nodal["DISPL" + axis] for axis in "XYZ"])
        self.x = self.X + self.u


def table(text):
    """Columns by their names without units, and the units."""
    rows = list(csv.reader(io.StringIO(text)))
    names = [head.rsplit(" [", 1)[0] for head in rows[0]]
    units = [head.rsplit(" [", 1)[1].rstrip("]") for head in rows[0]]
    return {name: [row[c] for row in rows[1:]] for c, name in enumerate(names)}, dict(zip(names, units))


def reals(column):
    return numpy.array([float(word) for word in column])


def grid(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    assert reader.CanReadFile(str(path))
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def names_of(data):
    return [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]


def array(data, name):
    return vtk_to_numpy(data.GetArray(name))
