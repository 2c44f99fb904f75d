"""`cleave point` and `cleave sample`: numbers against closed forms and numpy, and what is refused."""

import csv
import io
import pathlib
import subprocess
import sys
import tempfile
import unittest

import netCDF4
import numpy as np

PROGRAM = pathlib.Path(sys.argv[1]).resolve()

# MPa: G = 80193.8, kappa = 164206
G, KAPPA = 80193.8, 164206.0
E, NU = 9 * KAPPA * G / (3 * KAPPA + G), (3 * KAPPA - 2 * G) / (2 * (3 * KAPPA + G))
STEEL = [f"E={E:.17g}", f"nu={NU:.17g}", "rho=7.8e-9", "tau_y0=450", "tau_inf=715", "h0=129.24", "alpha=16.93"]


class Command(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.folder = pathlib.Path(directory.name)

    def cleave(self, *words):
        return subprocess.run([PROGRAM, *words], cwd=self.folder, text=True, capture_output=True, timeout=60,
                              check=False)

    def refused(self, *words, code=2):
        run = self.cleave(*words)
        self.assertEqual(run.returncode, code, run.stderr)
        self.assertTrue(run.stderr.startswith("cleave: "), run.stderr)
        return run.stderr

    def table(self, *words):
        """Columns by name without units, and the units."""
        run = self.cleave(*words)
        self.assertEqual(run.returncode, 0, run.stderr)
        rows = list(csv.reader(io.StringIO(run.stdout)))
        names = [cell.split()[0] for cell in rows[0]]
        self.units = {cell.split()[0]: cell[cell.index("["):] for cell in rows[0]}
        values = np.array([[float(cell) for cell in row] for row in rows[1:]])
        return {name: values[:, k] for k, name in enumerate(names)}

    def path(self, text):
        (self.folder / "path.csv").write_text(text)
        return ["--path", "path.csv"]


class Point(Command):
    def test_single_steps_of_the_return_mapping(self):
        path = self.path("time,F_xx\n0,1\n1,1.01\n")
        rows = self.table("point", "j2", *STEEL, *path)
        np.testing.assert_allclose(rows["P_xx"][-1], 1928.470758994, rtol=1e-12)
        np.testing.assert_allclose(rows["P_yy"][-1], 1476.978308821, rtol=1e-12)
        np.testing.assert_allclose(rows["equivalent_plastic_strain"][-1], 4.676722834696e-03, rtol=1e-12)
        self.assertEqual(rows["P_xy"][-1], 0)
        self.assertEqual(self.units["P_xx"], "[Pa]")
        path = self.path("time,F_xx,F_xy,F_yx,F_yy,F_yz,F_zy,F_zz\n0,1,0,0,1,0,0,1\n"
                         "1,1.05,0.02,-0.01,0.97,0.03,0.01,1.02\n")
        rows = self.table("point", "j2", *STEEL, *path)
        np.testing.assert_allclose(rows["equivalent_plastic_strain"][-1], 4.964519837591e-02, rtol=1e-11)
        np.testing.assert_allclose([rows["P_" + c][-1] for c in ("xx", "xy", "yx", "zy", "zz")],
                                   [6213.023434, 98.96678244, -83.75612583, -28.11934257, 6173.580130], rtol=1e-9)

    def test_elastic_law_over_steps(self):
        path = self.path("time [s],H_xx,H_yz\n0,0,0\n2,0.1,0.04\n")
        rows = self.table("point", "svk", "rho=1", "E=5", "nu=0.3", *path, "--steps", "4")
        np.testing.assert_allclose(rows["time"], [0, 0.5, 1, 1.5, 2])
        mu, lam = 5 / 2.6, 5 * 0.3 / (1.3 * 0.4)
        energy = []
        for k, h in enumerate(np.linspace(0, 0.1, 5)):
            f = np.eye(3) + np.array([[h, 0, 0], [0, 0, 0.4 * h], [0, 0, 0]])
            e = (f.T @ f - np.eye(3)) / 2
            p = f @ (lam * np.trace(e) * np.eye(3) + 2 * mu * e)
            for r, a in enumerate("xyz"):
                for c, b in enumerate("xyz"):
                    self.assertAlmostEqual(rows[f"P_{a}{b}"][k], p[r, c], delta=1e-15)
                    self.assertAlmostEqual(rows[f"F_{a}{b}"][k], f[r, c], delta=1e-15)
            tau = p @ f.T
            s = tau - np.trace(tau) / 3 * np.eye(3)
            self.assertAlmostEqual(rows["kirchhoff_equivalent_stress"][k], np.sqrt(1.5 * np.sum(s * s)), delta=1e-14)
            energy.append(lam / 2 * np.trace(e) ** 2 + mu * np.sum(e * e))
        np.testing.assert_allclose(rows["energy"], energy, rtol=1e-13)
        np.testing.assert_array_equal(rows["plastic_work"], 0)

    def test_plastic_work_is_the_work_not_stored(self):
        path = self.path("time,H_xx,H_xy\n0,0,0\n1,0.05,0.05\n")
        rows = self.table("point", "j2", *STEEL, *path, "--steps", "2000")
        work = sum(np.sum((rows["P_" + c][1:] + rows["P_" + c][:-1]) / 2 * np.diff(rows["F_" + c]))
                   for c in ("xx", "xy"))
        self.assertGreater(rows["plastic_work"][-1], 10)
        self.assertAlmostEqual((rows["energy"][-1] + rows["plastic_work"][-1]) / work, 1, delta=1e-4)

    def test_plane_kinematics(self):
        path = self.path("time,F_xx\n0,1\n1,1.02\n")
        words = ["point", "svk", "rho=1", "E=5", "nu=0.3", *path, "--kinematics"]
        strain, stress = self.table(*words, "plane_strain"), self.table(*words, "plane_stress")
        self.assertGreater(strain["P_zz"][-1], 0)
        self.assertEqual(stress["P_zz"][-1], 0)
        self.assertLess(stress["P_xx"][-1], strain["P_xx"][-1])
        path = self.path("time,F_xx,F_zz\n0,1,1\n1,1.02,1.1\n")
        self.assertIn("path.csv:3: F_zz is not that of no deformation", self.refused(*words, "plane_strain"))

    def test_what_is_refused(self):
        good = self.path("time,F_xx\n0,1\n1,1.02\n")
        elastic = ["svk", "rho=1", "E=5", "nu=0.3"]
        self.assertIn('did you mean "svk"?', self.refused("point", "svc", *elastic[1:], *good))
        self.assertIn("needs the property E [Pa]", self.refused("point", "svk", "rho=1", "nu=0.3", *good))
        self.assertIn('did you mean "nu"?', self.refused("point", *elastic[:3], "mu=0.3", *good))
        self.assertIn("not a finite number", self.refused("point", *elastic[:3], "nu=big", *good))
        self.assertIn("is not NAME=VALUE", self.refused("point", *elastic, "7", *good))
        self.assertIn("nu", self.refused("point", *elastic[:3], "nu=0.7", *good))
        self.assertIn("--path is required", self.refused("point", *elastic))
        self.assertIn("cannot be opened", self.refused("point", *elastic, "--path", "none.csv"))
        for text, answer in [
                ("time,F_xx\n0,1\n0,1.1\n", "path.csv:3: times must increase"),
                ("F_xx\n1\n1.1\n", "there is no column time"),
                ("time,Fxx\n0,1\n", 'did you mean "F_xx"?'),
                ("time,F_xx\n0,1,2\n", "path.csv:2: 3 numbers for the 2 columns"),
                ("time,F_xx\n0,nan\n", "is not a finite number"),
                ("time,F_xx\n0,1e\n", "is not a finite number"),
                ("time,F_xx\n", "no rows after the header")]:
            self.assertIn(answer, self.refused("point", *elastic, *self.path(text)))

    def test_a_law_without_an_answer_ends_the_path(self):
        path = self.path("time,F_xx\n0,1\n0.25,-1\n")
        self.assertIn("at time 0.25: ", self.refused("point", "j2", *STEEL, *path, code=1))


DECK = """
&run units='other' name='case' mode='static' t_end=1 /
&lattice type='square' spacing=1 size=4,3,0 /
&body name='plate' kinematics='plane_strain' material='metal' formulation='fem' elements='quadratic' /
&material name='metal' law='j2' rho=1 E=100 nu=0.3 tau_y0=1 tau_inf=2 alpha=5 /
&load name='low' kind='displacement' set='ymin' directions='xy' /
&load name='top' kind='displacement' set='ymax' directions='xy' value=0.2 curve='linear' ramp=1 /
&output fields='displacement', 'equivalent_plastic_strain', 'cauchy_stress' /
"""


class Sample(Command):
    def setUp(self):
        super().setUp()
        (self.folder / "case.nml").write_text(DECK)
        run = self.cleave("case.nml", "--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)

    def sample(self, points, fields, *words):
        lines = ["X [m],Y"] + [f"{x:.17g},{y:.17g}" for x, y in points]
        (self.folder / "points.csv").write_text("\n".join(lines) + "\n")
        return self.table("sample", ".", "--at", "points.csv", "--fields", fields, *words)

    def results(self):
        with netCDF4.Dataset(self.folder / "case.exo") as file:
            def named(kind):
                names = netCDF4.chartostring(file[f"name_{kind}_var"][:])
                return {str(name).strip("\x00 "): k + 1 for k, name in enumerate(names)}
            nodal, element = named("nod"), named("elem")
            self.positions = np.stack([file["coordx"][:], file["coordy"][:]], axis=1)
            self.connect = file["connect1"][:] - 1
            self.kind = file["connect1"].elem_type
            self.nodal = {name: file[f"vals_nod_var{k}"][-1] for name, k in nodal.items()}
            self.element = {name: file[f"vals_elem_var{k}eb1"][-1] for name, k in element.items()}

    def test_particles_have_their_own_values(self):
        self.results()
        self.assertTrue(self.kind.upper().startswith("TRI"))
        self.assertEqual(self.connect.shape[1], 6)
        rows = self.sample(self.positions, "displacement")
        np.testing.assert_array_equal(rows["inside"], 1)
        np.testing.assert_allclose(rows["displacement_x"], self.nodal["DISPLX"], atol=1e-13)
        np.testing.assert_allclose(rows["displacement_y"], self.nodal["DISPLY"], atol=1e-13)

    def test_results_show_the_mean_of_an_element_that_its_middle_has(self):
        self.results()
        middles = self.positions[self.connect[:, :3]].mean(axis=1)
        rows = self.sample(middles, "equivalent_plastic_strain,cauchy_stress")
        for name in ("equivalent_plastic_strain", "cauchy_stress_xx", "cauchy_stress_xy"):
            self.assertGreater(np.abs(self.element[name]).max(), 1e-3)
            np.testing.assert_allclose(rows[name], self.element[name], rtol=1e-9, atol=1e-13)

    def test_six_nodes_interpolate_quadratically(self):
        self.results()
        corners = self.nodal["DISPLX"][self.connect]
        weights = np.array([0.5, 0.3, 0.2])
        shape = np.concatenate([weights * (2 * weights - 1), 4 * weights * np.roll(weights, -1)])
        points = np.einsum("a,eak->ek", weights, self.positions[self.connect[:, :3]])
        rows = self.sample(points, "displacement", "--body", "plate")
        np.testing.assert_allclose(rows["displacement_x"], corners @ shape, atol=1e-13)

    def test_outside_is_said(self):
        rows = self.sample([(0.5, 0.5), (5, 0.5), (-1e9, 7)], "displacement,pressure")
        np.testing.assert_array_equal(rows["inside"], [1, 0, 0])
        np.testing.assert_array_equal(rows["pressure"][1:], 0)

    def test_what_is_refused(self):
        (self.folder / "points.csv").write_text("X,Y\n1,1\n")
        words = ["sample", ".", "--at", "points.csv", "--fields"]
        self.assertIn('did you mean "displacement"?', self.refused(*words, "displacment"))
        self.assertIn("is not a field of particles", self.refused(*words, "ledger"))
        self.assertIn("'p' is not one of the bodies", self.refused(*words, "pressure", "--body", "p"))
        self.assertIn("--fields is required", self.refused("sample", ".", "--at", "points.csv"))
        self.assertIn("cannot be opened", self.refused("sample", ".", "--at", "no.csv", "--fields", "pressure"))
        (self.folder / "points.csv").write_text("X,y\n1,1\n")
        self.assertIn("there is no column Y", self.refused(*words, "pressure"))
        self.assertIn("case.exo", self.refused("sample", "case.exo", "--at", "points.csv", "--fields", "pressure"))
        self.assertEqual(self.cleave("sample", "nowhere", "--at", "points.csv", "--fields", "u").returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
