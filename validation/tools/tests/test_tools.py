"""Decks, measures of cracks and curves, interpolation, rate equations, result reader and picture, on made-up data with known answers."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
import netCDF4  # noqa: E402
import numpy  # noqa: E402
from tools import crack_angle, cracks, curves, deck, host_code, interpolation, lattice_sums, picture, rates, rectangle, results, simulation  # noqa: E402

DECK = """! a deck
&run
  t_end = 1e-3, units = 'SI'   ! t_end = 5
/
&load
  value = 0
/
&load
  Value = 1.5 ! up
  set   = 'top, left'
/
"""


class Decks(unittest.TestCase):
    def test_values_are_replaced_and_nothing_else(self):
        changed = deck.vary(DECK, {"run.t_end": 2e-6, "run.units": "it's", "load(2).value": [1, 2], "load(2).set": "a"})
        expected = DECK.replace("t_end = 1e-3, units = 'SI'", "t_end = 2e-06, units = 'it''s'")
        expected = expected.replace("Value = 1.5 ! up", "Value = 1, 2 ! up").replace("'top, left'", "'a'")
        self.assertEqual(changed, expected)

    def test_logical(self):
        self.assertIn("value = .false.", deck.vary(DECK, {"load.value": False}))

    def test_what_is_not_there_is_named(self):
        for change, message in (({"run.speed": 1}, "no key 'speed'"), ({"runs.t_end": 1}, "no group &runs"),
                                ({"load(3).value": 1}, "number 3"), ({"t_end": 1}, "group.key")):
            with self.assertRaisesRegex(deck.DeckError, message):
                deck.vary(DECK, change)

    def test_a_group_can_be_taken_out(self):
        text = "! about &cpd\n&run\n  t_end = 1\n/\n\n&cpd\n  C2 = 0\n/\n\n&load\n/\n"
        self.assertEqual(deck.without(text, "cpd"), "! about &cpd\n&run\n  t_end = 1\n/\n\n&load\n/\n")
        with self.assertRaisesRegex(deck.DeckError, "no group &wall"):
            deck.without(text, "wall")


class LatticeSums(unittest.TestCase):
    """Against the continuum, and numbers of the theory with three digits."""

    def test_many_points_are_a_continuum(self):
        for dimension, reach in ((2, 60), (3, 20)):
            C11, C44 = lattice_sums.bond_moduli(reach, dimension)
            self.assertAlmostEqual(C11, 3, delta=0.02)  # measured 0.010 and 0.007
            self.assertAlmostEqual(C44, 1, delta=0.01)
            C11, C44 = lattice_sums.state_moduli(reach, 2, dimension)
            self.assertAlmostEqual(C11, 2 + 2 * (dimension - 1) / dimension, delta=0.01)
            self.assertAlmostEqual(C44, 1, delta=0.01)
            self.assertAlmostEqual(lattice_sums.toughness(reach, dimension), 1, delta=0.01)

    def test_few_points_have_their_own_constants(self):
        ball = 4 / 3 * numpy.pi * 3.015**3 / lattice_sums.number(3.015)
        C11, C44 = lattice_sums.bond_moduli(3.015)
        self.assertEqual(lattice_sums.number(3.015), 122)
        for found, expected in ((C11 / 3, 0.975), (C44, 1.123), (lattice_sums.toughness(3.015), 1.053)):
            self.assertAlmostEqual(ball * found, expected, delta=0.0006)


class Cracks(unittest.TestCase):
    def test_arrival(self):
        x, time = numpy.array([1.0, 8.9, 9.1, 9.9]), numpy.array([1.0, 2.0, 4.0, 3.0])
        self.assertEqual(cracks.arrival_time(x, time, 10.0, 1.0), 3.0)
        self.assertTrue(numpy.isnan(cracks.arrival_time(x, time, 20.0, 1.0)))

    def test_tip_speed_ignores_what_breaks_behind_the_tip(self):
        time = numpy.linspace(0, 1, 101)
        x = numpy.concatenate([3 * time, 0.5 * time])
        self.assertAlmostEqual(cracks.tip_speed(x, numpy.concatenate([time, time]), 0.5, 2.5), 3.0, places=12)
        self.assertTrue(numpy.isnan(cracks.tip_speed(x[:2], time[:2], 0.5, 2.5)))

    def test_branches_of_a_fork(self):
        stem = numpy.arange(0, 10, 0.5)
        fork = numpy.arange(10, 30, 0.25)
        x = numpy.concatenate([stem, fork, fork])
        y = numpy.concatenate([0 * stem, (fork - 10) / 2, (10 - fork) / 2])
        self.assertEqual(cracks.cracks_at(x, y, 5.0, 0.5), 1)
        self.assertEqual(cracks.cracks_at(x, y, 20.0, 0.5), 2)
        self.assertEqual(cracks.cracks_at(x, y, 40.0, 0.5), 0)
        self.assertEqual(cracks.branches(x, y, 15, 29, 0.5), (2.0, 2))
        mean, largest = cracks.branches(x, y, 0, 29, 0.5)
        self.assertTrue(1 < mean < 2 and largest == 2)

    def test_path_distance(self):
        x = numpy.arange(5.0)
        self.assertEqual(cracks.path_distance(x, 0 * x, x, 0 * x), 0.0)
        self.assertEqual(cracks.path_distance(x, 0 * x, x, 0 * x + 2), 2.0)


class CrackAngle(unittest.TestCase):
    tip = (50.0, 20.0)

    def band(self, degrees, side=1, length=40.0):
        """A lattice around the tip; damage 1 within 1.5 of a crack of that angle, 0.3 within 4."""
        line = numpy.arange(-60.0, 60.5)
        offsets = numpy.stack(numpy.meshgrid(line, line, indexing="ij"), -1).reshape(-1, 2) + 0.25
        unit = numpy.array([numpy.cos(numpy.radians(degrees)), side * numpy.sin(numpy.radians(degrees))])
        along, across = offsets @ unit, abs(offsets @ numpy.array([-unit[1], unit[0]]))
        inside = (along > 0) & (along < length)
        return offsets + self.tip, numpy.where(inside & (across < 1.5), 1.0, numpy.where(inside & (across < 4), 0.3, 0.0))

    def crack(self, points, damage, **frame):
        return crack_angle.crack_points(points, damage, self.tip, 30, 1.0, **frame)

    def test_known_angles_on_both_sides(self):
        for degrees in (20, 64, 85):
            for side in (1, -1):
                points, damage = self.band(degrees, side)
                crack = self.crack(points, damage, side=side)
                self.assertAlmostEqual(crack_angle.angle(points[crack], self.tip, side=side), degrees, delta=1.5)   # measured 1.3
                self.assertLess(self.crack(points, damage, side=-side).sum(), 6)

    def test_a_notch_that_points_elsewhere(self):
        points, damage = self.band(30)
        crack = self.crack(points, damage, ahead=(0, 2), side=-1)
        self.assertAlmostEqual(crack_angle.angle(points[crack], self.tip, ahead=(0, 2), side=-1), 60, delta=1.5)    # measured 0.2

    def test_what_lies_beyond_or_behind_or_apart_does_not_count(self):
        points, damage = self.band(64)
        expected = self.crack(points, damage)
        offsets = points - self.tip
        for other in (numpy.hypot(*offsets.T) > 30, offsets[:, 0] < 0, offsets[:, 1] < 0, abs(offsets[:, 0] - 25) < 3):
            numpy.testing.assert_array_equal(self.crack(points, numpy.where(other, 1.0, damage)), expected)
        self.assertTrue(70 < expected.sum() < 100)
        self.assertTrue(29 < crack_angle.extent(points[expected], self.tip) <= 30)

    def test_too_few_points(self):
        self.assertTrue(numpy.isnan(crack_angle.angle(numpy.zeros((2, 2)), self.tip)))
        points, damage = self.band(64)
        self.assertEqual(self.crack(points, 0 * damage).sum(), 0)
        self.assertEqual(crack_angle.extent(points[:0], self.tip), 0)


class Curves(unittest.TestCase):
    strain = numpy.linspace(0, 0.05, 501)
    stress = numpy.where(strain < 0.002, 250e3 * strain, 500 + 2e3 * (strain - 0.002))

    def test_slope_and_knee(self):
        self.assertAlmostEqual(curves.slope((self.strain, self.stress), 50, 350), 250e3, delta=1e-6)
        self.assertAlmostEqual(curves.knee((self.strain, self.stress), 250e3), 500, delta=0.2)

    def test_slope_ends_where_the_stress_was_exceeded_first(self):
        softened = numpy.where(self.strain > 0.03, 100.0, self.stress)
        self.assertAlmostEqual(curves.slope((self.strain, softened), 50, 350), 250e3, delta=1e-6)

    def test_largest_difference_only_between_the_strains(self):
        other = self.stress * (1 + 0.5 * (self.strain < 0.01) - 0.03 * (self.strain > 0.03))
        found = curves.largest_difference((self.strain, other), (self.strain, self.stress), 0.02, 0.05)
        self.assertAlmostEqual(found, 3.0, places=9)

    def test_error_norm(self):
        self.assertAlmostEqual(curves.error_norm([3.0, 4.0], [3.0, 3.0]), 100 / numpy.sqrt(18), places=12)


class Interpolation(unittest.TestCase):
    def setUp(self):
        self.points, self.targets = (numpy.random.default_rng(7).uniform(0, 1, (count, 2)) for count in (400, 50))

    def test_quadratic_fields_are_exact(self):
        field = lambda p: 1 + p[:, 0] - 2 * p[:, 1] + 3 * p[:, 0] * p[:, 1] - p[:, 1] ** 2  # noqa: E731
        between = interpolation.Interpolation(self.points, self.targets)
        self.assertLess(abs(between(field(self.points)) - field(self.targets)).max(), 1e-10)   # measured 5e-14

    def test_third_order(self):
        field = lambda p: numpy.sin(3 * p[:, 0]) * numpy.cos(2 * p[:, 1])  # noqa: E731
        errors = []
        for side in (20, 40):
            line = (numpy.arange(side) + 0.5) / side
            points = numpy.array([(x, y) for y in line for x in line])
            errors.append(abs(interpolation.Interpolation(points, self.targets)(field(points)) - field(self.targets)).max())
        self.assertGreater(numpy.log2(errors[0] / errors[1]), 2.5)

    def test_neighbours_are_the_nearest(self):
        found = interpolation.nearest(self.points, self.targets, 5)
        distance = numpy.linalg.norm(self.points[None] - self.targets[:, None], axis=2)
        numpy.testing.assert_array_equal(found, numpy.argsort(distance, axis=1)[:, :5])


class Rectangles(unittest.TestCase):
    X, Y = rectangle.graded_to_both_ends(10.0, 6, 0.1), rectangle.graded(29.0, 5, 1.0, 0.05)

    def test_lines_are_small_where_asked_and_fit(self):
        self.assertEqual((self.X[0], self.X[-1], self.Y[0]), (0.0, 10.0, 0.0))
        self.assertAlmostEqual(self.Y[-1], 29.0)
        numpy.testing.assert_allclose(self.X + self.X[::-1], 10.0)
        sizes = numpy.diff(self.Y)
        numpy.testing.assert_allclose((sizes[-1] / sizes[0], numpy.diff(self.X)[0] / numpy.diff(self.X)[2]), (0.05, 0.1))

    def test_triangles_turn_the_same_way_and_fill_the_rectangle(self):
        lines = rectangle.mesh(self.X, self.Y).split("\n")
        count = int(lines[4])
        points = numpy.array([line.split() for line in lines[5:5 + count]], float)[:, 1:3]
        corners = numpy.array([line.split()[5:] for line in lines[8 + count:-2]], int) - 1
        a, b = (points[corners[:, k]] - points[corners[:, 0]] for k in (1, 2))
        areas = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
        self.assertEqual(len(areas), 60)
        self.assertGreater(areas.min(), 0)
        self.assertAlmostEqual(areas.sum(), 290.0)

    def test_quadratic_fields_are_read_exactly(self):
        columns, rows = numpy.meshgrid(rectangle.with_middles(self.X), rectangle.with_middles(self.Y))
        points = numpy.random.default_rng(1).permutation(numpy.column_stack([columns.ravel(), rows.ravel()]))
        places = numpy.random.default_rng(2).uniform((0, 0), (10, 29), (50, 2))
        field = lambda p: 1 + p[:, 0] ** 2 - 3 * p[:, 0] * p[:, 1] + p[:, 1] ** 2
        grid = rectangle.Grid(self.X, self.Y, points)
        numpy.testing.assert_allclose(grid.at(field(points), places), field(places), rtol=1e-10, atol=1e-10)
        numpy.testing.assert_allclose(grid.at(field(points), points), field(points), rtol=1e-10, atol=1e-10)
        with self.assertRaises(ValueError):
            rectangle.Grid(self.X, self.Y, points[1:])


class Rates(unittest.TestCase):
    law = rates.J2(80000.0, 170000.0, 400.0, 700.0, 100.0, 15.0)

    def test_extrapolation_of_an_exponential(self):
        found = rates.extrapolated(lambda t, y: -y, 0.0, 1.0, numpy.array([1.0]))
        self.assertAlmostEqual(found[0], numpy.exp(-1), delta=1e-13)

    def test_uniaxial_strain_has_a_closed_form(self):
        end = numpy.diag([1.2, 1.0, 1.0])
        _, plastic = rates.follow(self.law, [numpy.eye(3), end])[-1][1:]
        stress = 2 * self.law.G * numpy.log(1.2) - 3 * self.law.G * plastic     # the direction of flow is constant
        self.assertAlmostEqual(stress, self.law.strength(plastic), delta=1e-7)

    def test_unloading_at_a_corner_and_reversal(self):
        shear = lambda value: numpy.array([[1, value, 0], [0, 1, 0], [0, 0, 1.0]])  # noqa: E731
        states = rates.follow(self.law, [shear(0), shear(0.02), shear(0.019), shear(-0.02)], parts=10)
        plastic = [state[2] for state in states]
        self.assertEqual(plastic[1], plastic[2])
        self.assertGreater(plastic[3], plastic[2] + 0.01)
        for F, Cpi, e in (states[1], states[3]):
            self.assertAlmostEqual(self.law.equivalent(F, Cpi) / self.law.strength(e), 1, delta=1e-9)
            self.assertAlmostEqual(numpy.linalg.det(Cpi), 1, delta=1e-10)

    def test_unloading_inside_a_piece(self):
        """A chord of a rotation compresses, unloads and stretches again; where flow ends must not depend on the parts."""
        c, s = numpy.cos(0.26), numpy.sin(0.26)
        turned = numpy.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        coarse, fine = (rates.follow(self.law, [numpy.eye(3), turned], parts)[-1] for parts in (2, 3))
        self.assertGreater(fine[2], 0.005)
        self.assertAlmostEqual(coarse[2] / fine[2], 1, delta=1e-9)      # measured 2e-12
        self.assertAlmostEqual(self.law.equivalent(*fine[:2]) / self.law.strength(fine[2]), 1, delta=1e-9)

    def test_plastic_work_is_the_integral_of_the_strength(self):
        e = numpy.linspace(0, 0.3, 3001)
        strength = self.law.strength(e)
        self.assertAlmostEqual(self.law.plastic_work(0.3), (strength[:-1] + strength[1:]).sum() / 2 * 1e-4, delta=1e-4)


class Commands(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def execute(self, script, run):
        program = self.folder / "cleave"
        program.write_text(f"#!/bin/sh\n{script}\n")
        program.chmod(0o755)
        return simulation.execute(run, self.folder, self.folder / "work", str(program), 1)

    def test_output_of_a_command_is_a_table_and_its_inputs_are_written(self):
        run = simulation.Run("one", command=("point", "law"), inputs={"path.csv": "3,4\n"})
        result = self.execute("echo 'a [m],b'; cat path.csv; echo $#,0; echo note >&2", run)
        self.assertEqual({name: list(column) for name, column in result.table.items()}, {"a": [3, 2], "b": [4, 0]})

    def test_what_a_run_took_is_kept(self):
        cost = self.execute("echo a; i=0; while [ $i -lt 30000 ]; do i=$((i+1)); done; sleep 0.3", simulation.Run("one", command=("x",))).cost
        self.assertGreater(cost["wall"], 0.3)
        self.assertTrue(0.005 < cost["processor"] < cost["wall"] - 0.25)
        self.assertTrue(0.1 < cost["memory"] < 20)                      # of a shell, not of this Python

    def test_a_failed_command_shows_its_message(self):
        with self.assertRaisesRegex(simulation.RunError, "ended with 2.*\n.*no such law"):
            self.execute("echo no such law >&2; exit 2", simulation.Run("one", command=("point", "law")))


class HostCodes(unittest.TestCase):
    """With a script in the place of a compiled host."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.top = pathlib.Path(temporary.name)
        case = self.top / "case"
        case.mkdir()
        (case / "Makefile").write_text("host: host.f\n\techo $(CLEAVE_PREFIX) $(FFLAGS) > $@\n\tcat host.f >> $@; chmod +x $@\n")
        (case / "host.f").write_text("not run\n")
        (self.top / "work").mkdir()
        self.site = simulation.Site(case, self.top / "work", str(self.top / "prefix/bin/cleave"))

    def test_an_installation_is_its_own_prefix(self):
        self.assertEqual(host_code.install(self.site), (self.top / "prefix").resolve())

    def test_sanitizers_are_an_obstacle(self):
        cache = self.top / "prefix/CMakeCache.txt"
        self.assertIsNone(host_code.obstacle(self.site.cleave))
        cache.parent.mkdir()
        for value, expected in (("OFF", None), ("ON", "a library built with sanitizers wants their run time in every host")):
            cache.write_text(f"CLEAVE_SANITIZE:BOOL={value}\n")
            self.assertEqual(host_code.obstacle(self.site.cleave), expected)

    def test_build_copies_the_sources_and_hands_over_prefix_and_variables(self):
        program = host_code.build("/opt/cleave", self.site, "host", "fast", FFLAGS="-O3 -g")
        self.assertEqual(program, self.top / "work/build-fast/host")
        self.assertEqual(program.read_text(), "/opt/cleave -O3 -g\nnot run\n")

    def test_run_gives_the_deck_threads_and_arguments(self):
        script = self.top / "script"
        script.write_text("#!/bin/sh\ncat\necho $OMP_NUM_THREADS $1\nexit 3\n")
        script.chmod(0o755)
        listing = host_code.run(script, self.top / "work/new", "deck ", threads=4, expected=3, arguments=["a"])
        self.assertEqual(listing, "deck 4 a\n")
        self.assertEqual((self.top / "work/new/listing").read_text(), listing)
        with self.assertRaisesRegex(simulation.RunError, "script ended with 3, not 0"):
            host_code.run(script, self.top / "work/new")

    def test_a_run_may_be_work_of_the_case(self):
        run = simulation.Run("r", work=lambda site: (site.folder / "made").write_text(site.cleave))
        result = simulation.execute(run, self.site.case_folder, self.top / "runs/r", "here", 1)
        self.assertEqual((result.folder / "made").read_text(), "here")


class PrintedTables(unittest.TestCase):
    def test_units_are_cut_off(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.csv"
            path.write_text("time [s],P_xx [Pa]\n0,1\n2,3.5\n")
            table = results.read_csv(path)
        self.assertEqual({name: list(column) for name, column in table.items()}, {"time": [0, 2], "P_xx": [1, 3.5]})


def write_exodus(path, side=6):
    """A cracked square sheet in the layout of Exodus II."""
    grid = numpy.arange(side) / 1000
    points = numpy.array([(x, y) for y in grid for x in grid])
    corner = [row * side + column for row in range(side - 1) for column in range(side - 1)]
    triangles = numpy.array([t for k in corner for t in ((k, k + 1, k + side + 1), (k, k + side + 1, k + side))]) + 1
    with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_OFFSET") as file:
        sizes = {"num_dim": 2, "num_nodes": len(points), "num_el_blk": 1, "num_el_in_blk1": len(triangles),
                 "num_nod_per_el1": 3, "len_name": 33, "num_nod_var": 3, "num_elem_var": 1, "time_step": None}
        for name, size in sizes.items():
            file.createDimension(name, size)
        for axis in (0, 1):
            file.createVariable("coord" + "xy"[axis], "f8", ("num_nodes",))[:] = points[:, axis]
        file.createVariable("connect1", "i4", ("num_el_in_blk1", "num_nod_per_el1"))[:] = triangles
        for kind, names in (("nod", ["DISPLX", "DISPLY", "damage"]), ("elem", ["status"])):
            table = file.createVariable(f"name_{kind}_var", "S1", (f"num_{kind}_var", "len_name"))
            for row, name in enumerate(names):
                table[row] = netCDF4.stringtochar(numpy.array([name], f"S{33}"))[0]
        file.createVariable("time_whole", "f8", ("time_step",))[:] = [0.0, 2e-6]
        fields = [1e-4 * points[:, 0], 0 * points[:, 0], points[:, 0] / points.max()]
        for number, values in enumerate(fields, 1):
            frames = file.createVariable(f"vals_nod_var{number}", "f8", ("time_step", "num_nodes"))
            frames[:] = numpy.array([0 * values, values])
        status = file.createVariable("vals_elem_var1eb1", "f8", ("time_step", "num_el_in_blk1"))
        status[:] = numpy.ones((2, len(triangles)))
        status[1, 3] = 0
    return points, triangles - 1


class Pictures(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.path = pathlib.Path(holder.name) / "sheet.exo"
        self.points, self.triangles = write_exodus(self.path)

    def test_reader(self):
        result = results.Exodus(self.path)
        numpy.testing.assert_array_equal(result.points[:, :2], self.points)
        self.assertTrue(result.is_plane and (result.points[:, 2] == 0).all())
        numpy.testing.assert_array_equal(result.simplices, self.triangles)
        numpy.testing.assert_array_equal(result.displacement(1)[:, 0], 1e-4 * self.points[:, 0])
        self.assertEqual(list(numpy.flatnonzero(~result.alive(1))), [3])
        self.assertTrue(result.alive(0).all())
        with self.assertRaisesRegex(KeyError, "it has DISPLX, DISPLY, damage"):
            result.nodal("demage")

    def test_picture(self):
        out = self.path.with_suffix(".png")
        picture.picture(self.path, out, title="sheet")
        self.assertEqual(out.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        image = picture.plt.imread(out)
        pale, dark = (image[..., :3].max(axis=-1) - image[..., :3].min(axis=-1) > 0.5), image.shape
        self.assertGreater(pale.mean(), 0.1, "no saturated colour in the picture")
        self.assertGreater(dark[1], 1200)

    def test_frame_numbers(self):
        self.assertEqual([picture.frame_number(text, 4) for text in ("last", "first", "2", "-2")], [3, 0, 2, 2])
        with self.assertRaises(SystemExit):
            picture.frame_number("4", 4)

    def test_automatic_magnification_is_round(self):
        displacement = numpy.zeros((2, 2))
        self.assertEqual(picture.magnification(numpy.array([[0, 0], [1, 1]]), displacement, "auto"), 1.0)
        displacement[1, 0] = 0.0011
        self.assertEqual(picture.magnification(numpy.array([[0, 0], [1, 1]]), displacement, "auto"), 20.0)
        self.assertEqual(picture.magnification(numpy.array([[0, 0], [1, 1]]), displacement, "3"), 3.0)


if __name__ == "__main__":
    unittest.main()
