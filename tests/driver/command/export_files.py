"""`cleave export`: its files as numpy and VTK read them, against what netCDF4 reads in the result."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from exported import Result, array, grid, names_of, reals, table, write_exodus

PROGRAM = pathlib.Path(sys.argv[1]).resolve()

# Small, but with deleted elements at the end.
DECK = """
&run units='mm-ms-g-MPa' title='a plate' name='case' t_end=40 /
&lattice type='hexagonal' spacing=1 size=12,8,0 /
&body name='plate' kinematics='plane_stress' material='unit' /
&material name='unit' law='svk' E=1 nu=0.25 rho=1 /
&fracture critical_strain=0.05 /
&precrack points=0,4,5,4 /
&load name='low' kind='displacement' set='ymin' directions='xy' /
&load name='top' kind='velocity' set='ymax' directions='y' value=0.05 /
&output every_steps=10 fields='velocity','cauchy_stress','damage' /
"""


class Export(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.directory.name)
        (cls.folder / "case.nml").write_text(DECK)
        run = subprocess.run([PROGRAM, "--quiet", "case.nml"], cwd=cls.folder, capture_output=True,
                             text=True, check=False)
        assert run.returncode == 0, run.stderr
        cls.before = (cls.folder / "case.exo").read_bytes()

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    def cleave(self, *words):
        return subprocess.run([PROGRAM, "export", *words], cwd=self.folder, text=True, timeout=60,
                              capture_output=True, check=False)

    def exported(self, *words):
        run = self.cleave(*words)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stderr, "")
        self.assertFalse(list(self.folder.glob("*.part")))
        self.assertEqual((self.folder / "case.exo").read_bytes(), self.before)
        return run.stdout

    def refused(self, *words):
        files = sorted(self.folder.iterdir())
        run = self.cleave(*words)
        self.assertEqual(run.returncode, 2, run.stdout + run.stderr)
        self.assertEqual(run.stdout, "")
        self.assertEqual(sorted(self.folder.iterdir()), files)
        self.assertEqual((self.folder / "case.exo").read_bytes(), self.before)
        return run.stderr

    def same(self, a, b):
        numpy.testing.assert_array_equal(a, b)

    def test_particles_to_csv(self):
        frame = Result(self.folder / "case.exo", -1)
        count = len(frame.times)
        self.assertEqual(self.exported("case.exo"),
                         f"case.exo: frame {count} of {count}, time 40.0: {len(frame.X)} particles to "
                         f"case.{count}.csv\n")
        columns, units = table((self.folder / f"case.{count}.csv").read_text())
        fields = [name.replace("DISPL", "displacement_").lower() for name in frame.nodal]
        self.assertIn("cauchy_stress_yx", fields)
        self.assertEqual(list(columns), ["id", "X", "Y", "Z", "x", "y", "z"] + fields)
        self.assertEqual(columns["id"], [str(i) for i in frame.ids])
        for axis in range(3):
            self.same(reals(columns["XYZ"[axis]]), frame.X[:, axis])
            self.same(reals(columns["xyz"[axis]]), frame.x[:, axis])
        self.assertEqual([units[name] for name in "XYZxyz"], ["mm"] * 6)
        for name, field in zip(frame.nodal, fields):
            self.same(reals(columns[field]), frame.nodal[name])
            self.assertEqual(units[field], frame.units[name])

    def test_elements_to_csv(self):
        frame = Result(self.folder / "case.exo", -1)
        deleted = frame.element["status"] == 0
        self.assertTrue(deleted.any() and not deleted.all())
        self.exported("case.exo", "--on", "elements", "--output", "elements.csv")
        columns, units = table((self.folder / "elements.csv").read_text())
        self.assertEqual(list(columns), ["id", "block", "X", "Y", "Z", "x", "y", "z", "node_1", "node_2",
                                         "node_3", "status"])
        nodes = frame.nodes[0]
        self.assertEqual(columns["id"], [str(e + 1) for e in range(len(nodes))])
        self.assertEqual(set(columns["block"]), {"plate"})
        for k in range(3):
            self.same([int(n) for n in columns[f"node_{k + 1}"]], frame.ids[nodes[:, k]])
            for letters, at in (("XYZ", frame.X), ("xyz", frame.x)):
                corner = [at[nodes[:, c], k] for c in range(3)]
                self.same(reals(columns[letters[k]]), ((corner[0] + corner[1]) + corner[2]) / 3)
        self.assertEqual(units["x"], "mm")
        self.same(reals(columns["status"]), frame.element["status"])
        self.exported("case.exo", "--on", "elements", "--alive", "--output", "elements.csv")
        columns, _ = table((self.folder / "elements.csv").read_text())
        self.same([int(e) - 1 for e in columns["id"]], numpy.flatnonzero(~deleted))

    def test_grid(self):
        frame = Result(self.folder / "case.exo", 1)
        said = self.exported("case.exo", "--step", "2", "--output", "out.vtu")
        self.assertIn(f"{len(frame.X)} particles and {len(frame.nodes[0])} elements to out.vtu", said)
        found = grid(self.folder / "out.vtu")
        points, cells = found.GetPointData(), found.GetCellData()
        self.assertEqual(array(found.GetFieldData(), "TimeValue"), frame.times[1])
        self.same(vtk_to_numpy(found.GetPoints().GetData()), frame.x)
        self.same(vtk_to_numpy(found.GetCells().GetConnectivityArray()), frame.nodes[0].ravel())
        self.assertEqual({found.GetCellType(c) for c in range(found.GetNumberOfCells())}, {vtk.VTK_TRIANGLE})
        self.assertEqual(names_of(points), ["id", "reference_position", "displacement", "velocity",
                                            "cauchy_stress", "damage"])
        self.assertEqual(names_of(cells), ["id", "block", "status"])
        self.same(array(points, "id"), frame.ids)
        self.same(array(points, "reference_position"), frame.X)
        self.same(array(points, "displacement"), frame.u)
        self.same(array(points, "damage"), frame.nodal["damage"])
        stress = points.GetArray("cauchy_stress")
        letters = [i + j for i in "xyz" for j in "xyz"]
        self.assertEqual([stress.GetComponentName(k) for k in range(9)], letters)
        self.assertEqual(stress.GetInformation().Get(vtk.vtkDataArray.UNITS_LABEL()), "MPa")
        zero = numpy.zeros(len(frame.X))
        for k, ij in enumerate(letters):
            self.same(vtk_to_numpy(stress)[:, k], frame.nodal.get("cauchy_stress_" + ij, zero))
        self.same(array(cells, "status"), frame.element["status"])

    def test_grid_without_deleted_elements_at_reference(self):
        frame = Result(self.folder / "case.exo", -1)
        self.exported("case.exo", "--format", "vtu", "--alive", "--configuration", "reference",
                      "--output", "alive.vtu", "--fields", "velocity_x,damage")
        found = grid(self.folder / "alive.vtu")
        alive = frame.element["status"] != 0
        self.same(vtk_to_numpy(found.GetPoints().GetData()), frame.X)
        self.same(vtk_to_numpy(found.GetCells().GetConnectivityArray()), frame.nodes[0][alive].ravel())
        self.assertEqual(names_of(found.GetPointData()),
                         ["id", "reference_position", "displacement", "velocity_x", "damage"])
        self.same(array(found.GetPointData(), "velocity_x"), frame.nodal["velocity_x"])
        self.same(array(found.GetCellData(), "status"), numpy.ones(alive.sum()))

    def test_choice_of_the_frame(self):
        times = Result(self.folder / "case.exo", 0).times
        self.assertGreater(len(times), 3)

        def taken(*words):
            return self.exported("case.exo", "--output", "frame.csv", *words)
        self.assertIn("frame 1 of", taken("--step", "first"))
        self.assertIn(f"frame {len(times)} of", taken("--step", "last"))
        self.assertIn("frame 3 of", taken("--step", "3"))
        near = 0.4 * times[1] + 0.6 * times[2]
        self.assertIn(f"frame 3 of {len(times)}, time {times[2]} (nearest to {near})",
                      taken("--time", repr(near)))
        columns, _ = table((self.folder / "frame.csv").read_text())
        self.same(reals(columns["displacement_y"]), Result(self.folder / "case.exo", 2).nodal["DISPLY"])
        self.assertIn("frame 2 of", taken("--time", repr(0.6 * times[1] + 0.4 * times[2])))
        self.assertIn("frame 1 of", taken("--time", "-5"))
        self.assertIn(f"frame {len(times)} of", taken("--time", "1e30"))
        for wrong in ("0", str(len(times) + 1), "-1", "2.5", "lst", "3x"):
            self.assertIn(f'--step "{wrong}": case.exo has frames 1 to {len(times)} (time 0 to 40); give',
                          self.refused("case.exo", "--step=" + wrong))
        self.assertIn("not a finite number", self.refused("case.exo", "--time", "nan"))
        self.assertIn("give one of them", self.refused("case.exo", "--time", "1", "--step", "2"))

    def test_choice_of_fields(self):
        def heads(*words):
            self.exported("case.exo", "--output", "fields.csv", *words)
            return list(table((self.folder / "fields.csv").read_text())[0])[7:]
        vector = ["velocity_x", "velocity_y", "velocity_z"]
        self.assertEqual(heads("--fields", "velocity"), vector)
        self.assertEqual(heads("--fields", "damage,velocity_y"), ["damage", "velocity_y"])
        self.assertEqual(heads("--fields", "damage", "--fields", "velocity", "--fields=damage"),
                         ["damage"] + vector)
        self.assertEqual(heads("--fields", "DISPLY"), ["displacement_y"])
        self.assertEqual(heads("--on", "elements", "--fields", "simplex_alive")[-1], "status")
        for wrong in ("damge", "velocity_w", "cauchy_stress_xz"):
            message = self.refused("case.exo", "--fields", "velocity," + wrong)
            self.assertIn(f'there is no field "{wrong}"', message)
            self.assertIn("Fields of particles: displacement, velocity, cauchy_stress, damage. "
                          "Fields of elements: status.", message)
        self.assertIn('did you mean "damage"?', self.refused("case.exo", "--fields", "damge"))
        self.assertIn('"status" is one of elements; add --on elements',
                      self.refused("case.exo", "--fields", "status"))
        self.assertIn('"damage" is one of particles; leave out --on elements',
                      self.refused("case.exo", "--fields", "damage", "--on", "elements"))

    def test_csv_on_the_screen(self):
        run = self.cleave("case.exo", "--output", "-", "--step", "first")
        self.assertEqual(run.returncode, 0)
        self.assertIn("frame 1 of", run.stderr)
        self.assertIn("to standard output", run.stderr)
        self.exported("case.exo", "--step", "first")
        self.assertEqual(run.stdout, (self.folder / "case.1.csv").read_text())
        self.assertIn("only CSV can go", self.refused("case.exo", "--output", "-", "--format", "vtu"))

    def test_options_that_contradict(self):
        self.assertIn("--configuration is for", self.refused("case.exo", "--configuration", "current"))
        self.assertIn("--on is for", self.refused("case.exo", "--on", "elements", "--output", "a.vtu"))
        self.assertIn("add --on elements", self.refused("case.exo", "--alive"))
        self.assertIn("--format", self.refused("case.exo", "--format", "vtk"))
        self.assertIn("RESULT is required", self.refused())
        self.assertIn("Did you mean --fields?", self.refused("case.exo", "--field", "damage"))

    def test_nothing_is_lost(self):
        self.assertIn("would overwrite the result itself", self.refused("case.exo", "--output", "case.exo"))
        (self.folder / "link.csv").symlink_to("case.exo")
        self.assertIn("would overwrite the result itself", self.refused("case.exo", "--output", "link.csv"))
        (self.folder / "link.csv").unlink()
        self.assertIn("exists and is not a .csv", self.refused("case.exo", "--output", "case.nml"))
        self.assertIn("a folder", self.refused("case.exo", "--output", "."))
        self.assertIn("its folder exists", self.refused("case.exo", "--output", "no/such/place.csv"))
        # The name under which the output is written first.
        part = self.folder / "new.csv.part"
        part.write_bytes(self.before)
        self.assertIn("would overwrite the result itself", self.refused(part.name, "--output", "new.csv"))
        self.assertEqual(part.read_bytes(), self.before)
        part.unlink()

    def test_files_that_cannot_be_read(self):
        self.assertIn('Did you mean "case.exo"?', self.refused("cse.exo"))
        self.assertIn("is a directory", self.refused("."))
        wrong = self.folder / "wrong.exo"
        for content, words in ((b"", "only 0 bytes long"), (b"notes, not results", "not a netCDF classic"),
                               (self.before[:3000], "the file is damaged or incomplete, use another")):
            wrong.write_bytes(content)
            self.assertIn(words, self.refused("wrong.exo"))
        # A run that was killed while it wrote its last frame.
        wrong.write_bytes(self.before[:-8])
        count = len(Result(self.folder / "case.exo", 0).times)
        self.assertIn(f"frame {count - 1} of {count - 1}",
                      self.exported("wrong.exo", "--output", "cut.csv"))
        self.assertIn("netCDF file, but not an Exodus", self.refused("case.history.nc"))
        wrong.unlink()


class OtherElements(unittest.TestCase):
    """Blocks of other kinds, in a file that Cleave did not write."""

    POINTS = numpy.array([[0, 0, 0], [2, 0, 0], [0, 2, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 3],
                          [5, 5, 5], [6, 5, 5]], float)
    BLOCKS = [("six", "TRI6", [[1, 2, 3, 4, 5, 6]]), ("solid", "TETRA", [[1, 2, 3, 7]]),
              ("dust, fine", "SPHERE", [[8], [9]]), ("rod", "BAR2", [[8, 9]])]

    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.addCleanup(self.directory.cleanup)
        self.folder = pathlib.Path(self.directory.name)

    def write(self, blocks, fields=("status", "energy")):
        random = numpy.random.default_rng(5)
        count, elements = len(self.POINTS), sum(len(nodes) for _, _, nodes in blocks)
        nodal = {name: random.normal(size=count) for name in (
            "DISPLX DISPLY DISPLZ s_xx s_yy s_zz s_xy s_yz s_xz e_xx e_yy e_xy h_1 h_2 w_x q_3").split()}
        element = {"status": numpy.arange(elements) % 2.0, "energy": random.normal(size=elements)}
        element = {name: element[name] for name in fields}
        write_exodus(self.folder / "other.exo", self.POINTS, blocks, nodal, element)
        return Result(self.folder / "other.exo", 0) if fields else None

    def cleave(self, *words):
        return subprocess.run([PROGRAM, "export", "other.exo", *words], cwd=self.folder, text=True,
                              timeout=60, capture_output=True, check=False)

    def grid(self, *words):
        run = self.cleave("--output", "out.vtu", *words)
        self.assertEqual(run.returncode, 0, run.stderr)
        return grid(self.folder / "out.vtu")

    def test_cells(self):
        frame = self.write(self.BLOCKS)
        found = self.grid()
        self.assertEqual([found.GetCellType(c) for c in range(5)],
                         [vtk.VTK_QUADRATIC_TRIANGLE, vtk.VTK_TETRA, vtk.VTK_VERTEX, vtk.VTK_VERTEX, vtk.VTK_LINE])
        nodes = [[found.GetCell(c).GetPointId(k) + 1 for k in range(found.GetCell(c).GetNumberOfPoints())]
                 for c in range(5)]
        self.assertEqual(nodes, [row for _, _, rows in self.BLOCKS for row in rows])
        self.assertEqual(list(array(found.GetCellData(), "block")), [1, 2, 3, 3, 4])
        numpy.testing.assert_array_equal(array(found.GetCellData(), "energy"), frame.element["energy"])
        # VTK's middles lie between the corners it takes them for.
        six = self.grid("--configuration", "reference").GetCell(0)
        for edge in range(3):
            a, b, middle = (numpy.array(six.GetEdge(edge).GetPoints().GetPoint(k)) for k in range(3))
            numpy.testing.assert_array_equal((a + b) / 2, middle)

    def test_arrays(self):
        frame = self.write(self.BLOCKS)
        points = self.grid().GetPointData()
        self.assertEqual(names_of(points),
                         ["id", "reference_position", "displacement", "s", "e", "h", "w_x", "q_3"])
        for name, parts in (("s", "xx yy zz xy yz xz"), ("e", "xx yy xy"), ("h", "1 2")):
            numpy.testing.assert_array_equal(
                array(points, name), numpy.transpose([frame.nodal[f"{name}_{part}"] for part in parts.split()]))
            components = [points.GetArray(name).GetComponentName(k) for k in range(len(parts.split()))]
            self.assertEqual(components, parts.split())

    def test_one_body(self):
        frame = self.write(self.BLOCKS)
        found = self.grid("--block", "dust, fine")
        numpy.testing.assert_array_equal(vtk_to_numpy(found.GetPoints().GetData()), frame.x[7:])
        self.assertEqual(list(array(found.GetPointData(), "id")), [8, 9])
        self.assertEqual(list(array(found.GetCellData(), "id")), [3, 4])
        self.assertEqual(self.cleave("--block", "dust, fine").returncode, 0)
        columns, _ = table((self.folder / "other.dust__fine.1.csv").read_text())
        self.assertEqual(columns["id"], ["8", "9"])
        wrong = self.cleave("--block", "sold")
        self.assertEqual(wrong.returncode, 2)
        self.assertIn('no body "sold"; did you mean "solid"? Bodies: six, solid, dust, fine, rod.', wrong.stderr)

    def test_elements_of_several_kinds(self):
        frame = self.write(self.BLOCKS)
        run = self.cleave("--on", "elements", "--output", "-")
        columns, _ = table(run.stdout)
        self.assertEqual(columns["block"], ["six", "solid", "dust, fine", "dust, fine", "rod"])
        self.assertEqual(columns["node_4"], ["4", "7", "", "", ""])
        self.assertEqual(columns["node_6"], ["6", "", "", "", ""])
        numpy.testing.assert_array_equal(reals(columns["energy"]), frame.element["energy"])
        self.assertEqual(columns["X"][4], "5.5")

    def test_alive_in_several_blocks(self):
        self.write(self.BLOCKS)
        self.assertEqual(list(array(self.grid("--alive").GetCellData(), "id")), [2, 4])
        self.write(self.BLOCKS, fields=("energy",))
        run = self.cleave("--alive", "--format", "vtu")
        self.assertEqual(run.returncode, 2)
        self.assertIn('has no element variable "status"', run.stderr)

    def test_no_elements(self):
        self.write([], fields=())
        found = self.grid()
        self.assertEqual([found.GetCellType(c) for c in range(len(self.POINTS))], [vtk.VTK_VERTEX] * len(self.POINTS))
        self.assertEqual(list(vtk_to_numpy(found.GetCells().GetConnectivityArray())), list(range(len(self.POINTS))))
        for words, said in ((("--on", "elements"), "there are no elements to export"),
                            (("--block", "a"), "so no bodies are named in it")):
            run = self.cleave(*words)
            self.assertEqual(run.returncode, 2)
            self.assertIn(said, run.stderr)

    def test_no_such_cell(self):
        self.write([("brick", "HEX8", [[1, 2, 3, 4, 5, 6, 7, 8]])])
        run = self.cleave("--format", "vtu")
        self.assertEqual(run.returncode, 2)
        self.assertIn('block "brick" consists of HEX8 with 8 nodes', run.stderr)
        self.assertEqual([p.name for p in self.folder.iterdir()], ["other.exo"])
        self.assertEqual(self.cleave("--on", "elements").returncode, 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
