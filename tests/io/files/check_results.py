"""Result files as VTK's own Exodus reader, and so ParaView, sees them."""

import netCDF4
import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from sample_files import sample_files

FRAMES = 4
LONG_NAME = "a_nodal_variable_with_a_name_longer_than_32_characters"
LONG_BLOCK = "block_with_a_name_that_is_longer_than_32_characters"


def open_reader(path, displace):
    reader = vtk.vtkExodusIIReader()
    assert reader.CanReadFile(path)
    reader.SetFileName(path)
    reader.UpdateInformation()
    for kind in (reader.NODAL, reader.ELEM_BLOCK, reader.GLOBAL):
        reader.SetAllArrayStatus(kind, 1)
    reader.SetAllArrayStatus(reader.NODE_SET, 1)
    for i in range(reader.GetNumberOfObjects(reader.NODE_SET)):
        reader.SetObjectStatus(reader.NODE_SET, i, 1)
    reader.SetGenerateGlobalNodeIdArray(True)
    reader.SetApplyDisplacements(displace)
    return reader


def names(reader, kind):
    return [reader.GetObjectName(kind, i) for i in range(reader.GetNumberOfObjects(kind))]


def variables(reader, kind):
    return [reader.GetObjectArrayName(kind, i) for i in range(reader.GetNumberOfObjectArrays(kind))]


def times(reader):
    key = vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    return list(reader.GetExecutive().GetOutputInformation(0).Get(key))


def blocks(reader, frame, kind=0):
    """The data sets of one frame: kind 0 element blocks, 7 node sets (VTK's order)."""
    reader.SetTimeStep(frame)
    reader.Update()
    part = reader.GetOutput().GetBlock(kind)
    return [part.GetBlock(i) for i in range(part.GetNumberOfBlocks())]


def point_array(block, name):
    return vtk_to_numpy(block.GetPointData().GetArray(name))


def nodal_value(frame, axis, node):
    return (frame + 1) * (axis + 1) * (node + 1) / 16


def check_block(block, frame, nodes, points, elements, dimension, displaced):
    """nodes: their indices in the file, in the order of the block's points."""
    shift = numpy.zeros((len(nodes), 3))
    for axis in range(dimension):
        shift[:, axis] = [nodal_value(frame, axis, n) for n in nodes]
    coordinates = vtk_to_numpy(block.GetPoints().GetData())
    numpy.testing.assert_array_equal(coordinates, points[nodes] + (shift if displaced else 0))
    numpy.testing.assert_array_equal(point_array(block, "DISPL"), shift)
    numpy.testing.assert_array_equal(point_array(block, LONG_NAME),
                                     [nodal_value(frame, dimension, n) for n in nodes])
    status = vtk_to_numpy(block.GetCellData().GetArray("status"))
    numpy.testing.assert_array_equal(status, [0 if e < frame else 1 for e in elements])
    stress = vtk_to_numpy(block.GetCellData().GetArray("stress_xx"))
    numpy.testing.assert_array_equal(stress, [100 * frame + e for e in elements])


def check_solid(path, displaced):
    points = numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1], [7, 8, 9], [9, 8, 7]], float)
    ids = numpy.array([101, 102, 103, 104, 105, 7, 8])
    reader = open_reader(path, displaced)
    assert reader.GetTitle() == "sample in 3 dimensions", reader.GetTitle()
    assert reader.GetDimensionality() == 3
    assert times(reader) == [0, 0.25, 0.5, 0.75]
    shown = [name.split(" Size:")[0] for name in names(reader, reader.ELEM_BLOCK)]
    assert [name.split(" ID:")[0].strip() for name in shown] == ["solid", LONG_BLOCK, "rod"], shown
    assert [n.split(" ID:")[0].strip() for n in names(reader, reader.NODE_SET)] == ["base", "tip"]
    assert variables(reader, reader.NODAL) == ["DISPL", LONG_NAME]
    assert variables(reader, reader.ELEM_BLOCK) == ["status", "stress_xx"]
    assert variables(reader, reader.GLOBAL) == ["kinetic_energy", "dt"]
    for frame in range(FRAMES):
        solid, dust, rod = blocks(reader, frame)
        assert [b.GetCellType(0) for b in (solid, dust, rod)] == [vtk.VTK_TETRA, vtk.VTK_VERTEX, vtk.VTK_LINE]
        for block, elements, corners in ((solid, [0, 1], [[0, 1, 2, 3], [1, 2, 3, 4]]),
                                         (dust, [2, 3], [[5], [6]]), (rod, [4], [[4, 5]])):
            shown_ids = point_array(block, "GlobalNodeId")
            nodes = numpy.array([list(ids).index(i) for i in shown_ids])
            check_block(block, frame, nodes, points, elements, 3, displaced)
            cells = [[nodes[block.GetCell(c).GetPointId(k)] for k in range(block.GetCell(c).GetNumberOfPoints())]
                     for c in range(block.GetNumberOfCells())]
            assert cells == corners, cells
        base, tip = blocks(reader, frame, 7)
        assert list(point_array(base, "GlobalNodeId")) == [101, 102, 103]
        assert list(point_array(tip, "GlobalNodeId")) == [105]
        field = solid.GetFieldData()
        kinetic = vtk_to_numpy(field.GetArray("kinetic_energy"))
        assert 0.5 * frame in kinetic, kinetic


def check_plate(path, displaced):
    points = numpy.array([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]], float)
    reader = open_reader(path, displaced)
    assert reader.GetDimensionality() == 2
    assert variables(reader, reader.NODAL) == ["DISPL", LONG_NAME]
    for frame in range(FRAMES):
        (plate,) = blocks(reader, frame)
        assert plate.GetCellType(0) == vtk.VTK_TRIANGLE
        nodes = point_array(plate, "GlobalNodeId") - 1
        check_block(plate, frame, nodes, points, [0, 1], 2, displaced)


def check_text(path):
    """What VTK does not show: units and info records."""
    with netCDF4.Dataset(path) as results:
        assert results["vals_nod_var1"].units == "mm"
        assert results["vals_nod_var1"].long_name == "displacement"
        assert results["vals_elem_var2eb3"].units == "MPa"
        assert results["vals_glo_var"].units == "kinetic_energy [mJ]; dt [ms]"
        records = [r.tobytes().split(b"\0")[0].decode() for r in results["info_records"][:].filled(b"\0")]
        assert records == ["units: mm-ms-g-MPa", "deck: &run", "  end_time = 1", "/"], records


with sample_files() as sample_folder:
    for displaced_too in (False, True):
        check_solid(sample_folder + "/solid.exo", displaced_too)
        check_plate(sample_folder + "/plate.exo", displaced_too)
    check_text(sample_folder + "/solid.exo")
