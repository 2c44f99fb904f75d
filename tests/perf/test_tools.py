"""What makes the table: medians and spread, the modelled traffic, LAMMPS' log, the page; with made-up measurements."""
import pathlib
import re
import unittest

import lammps
import measure
import table
import traffic


def step(case, threads, seconds, broken=0.0, **marks):
    return {"part": "step", "kind": "step", "case": case, "threads": threads, "seconds_per_step": seconds, "broken_per_step": broken,
            "dimension": 3, "wanted": 1000, **marks}


RECORDS = [
    {"part": "step", "kind": "model", "case": "svk", "dimension": 3, "wanted": 1000, "particles": 1000, "bonds": 7000, "bytes": 600000,
     "resident": 700000, "peak": 900000, "set_up_seconds": 0.002},
    *({"part": "step", "kind": "triad", "dimension": 3, "wanted": 1000, "threads": n, "bytes_per_second": n * 1e10} for n in (1, 2)),
    *(step("svk", 1, seconds) for seconds in (1e-4, 2e-4, 4e-4)),
    *(step("svk", 2, seconds) for seconds in (1e-4, 1e-4, 1e-4)),
]

LOG = """Peridynamic bonds:
  total # of bonds = 816728
  bonds/atom = 102.091
Per MPI rank memory allocation (min/avg/max) = 30.0 | 33.60 | 35.0 Mbytes
Loop time of 0.520118 on 2 procs for 10 steps with 8000 atoms
"""


class Tools(unittest.TestCase):
    def test_a_rate_is_the_median_of_its_turns_with_lowest_and_highest(self):
        row = next(line for line in table.steps(RECORDS).splitlines() if line.startswith("| 3D 1e3 svk"))
        self.assertIn("5 (2.5–10)", row)  # 1000 particles in 1e-4 s are 10 M/s
        self.assertIn("10 (10–10)", row)
        self.assertIn("2.00", row)

    def test_share_of_the_triad_is_of_the_modelled_bytes(self):
        moved = traffic.bytes_per_step("svk", 3, 14)
        row = next(line for line in table.steps(RECORDS).splitlines() if line.startswith("| 3D 1e3 svk"))
        self.assertIn(f"{100 * 5e6 * moved / 1e10:.0f} |", row)

    def test_cost_is_taken_turn_by_turn(self):
        records = RECORDS + [step("svk+search", 1, seconds) for seconds in (1.1e-4, 2.4e-4, 4.8e-4)]
        self.assertIn("20 (10 to 20)", table.prices(records))

    def test_cost_of_a_broken_bond(self):
        records = RECORDS + [step("svk+fracture", 1, 1e-4), step("svk+breaking", 1, 3e-4, broken=10)]
        self.assertIn("20 (20 to 20)", table.prices(records))

    def test_traffic_grows_with_what_a_case_does(self):
        for dimension, bonds in ((2, 6), (3, 14)):
            amounts = [traffic.bytes_per_step(c, dimension, bonds) for c in ("svk", "svk+search", "svk+search+viscosity")]
            self.assertEqual(amounts, sorted(set(amounts)))
        # eight doubles of history, read and written
        self.assertAlmostEqual(traffic.bytes_per_step("j2", 3, 14) - traffic.bytes_per_step("svk", 3, 14), 128)
        # at least every bond vector once
        self.assertGreater(traffic.bytes_per_step("svk", 3, 14), 7 * 24)

    def test_log_of_lammps(self):
        found = lammps.read_log(LOG)
        self.assertEqual(found["particles"], 8000)
        self.assertAlmostEqual(found["seconds_per_step"], 0.0520118)
        self.assertAlmostEqual(found["neighbours"], 102.091)
        self.assertAlmostEqual(found["bytes"], 2 * 33.60 * 2**20)

    def test_ratio_to_lammps_is_that_of_the_slower_case(self):
        marks = {"part": "lammps", "edge": 10}
        records = [{**r, **marks} for r in RECORDS if r["kind"] != "triad"]
        records += [{**lammps.read_log(LOG), "style": "lps", "threads": n, **marks} for n in (1, 2)]
        row = next(line for line in table.lammps(records).splitlines() if "peri/lps" in line)
        self.assertIn(f" {5e6 / (8000 / 0.0520118):.1f} |", row)

    def test_return_mapping_is_set_against_ours(self):
        records = [{"part": "mapping", "kind": "mapping", "name": f"{name}/plastic:{plastic}", "seconds": seconds}
                   for name, seconds in (("batch", 1e-8), ("textbook<IterativeEigen>", 4e-7)) for plastic in (0, 1)]
        row = next(line for line in table.mapping(records).splitlines() if "Eigen" in line)
        self.assertEqual(row.count(" 40 |"), 2)

    def test_numbers_have_three_digits(self):
        self.assertEqual([table.short(x) for x in (0, 0.12345, 12.345, 1234.5, 123456)], ["0", "0.123", "12.3", "1230", "123000"])

    def test_every_cell_of_a_table_stands_in_its_column(self):
        lines = table.grid("title", ["a", "b"], [["long name", "1"], ["x", "12345"]]).splitlines()[2:]
        self.assertEqual(len({len(line) for line in lines}), 1)
        self.assertEqual(table.grid("title", ["a"], []), "")

    def test_the_page_keeps_what_stands_around_the_table(self):
        page = f"before\n{table.BEGIN}\nold\n{table.END}\nafter\n"
        self.assertEqual(table.put_between_marks(page, "new"), f"before\n{table.BEGIN}\nnew\n{table.END}\nafter\n")

    def test_the_manual_has_one_place_for_the_table(self):
        page = measure.PAGE.read_text(encoding="utf-8")
        self.assertEqual([page.count(table.BEGIN), page.count(table.END)], [1, 1])

    def test_cases_of_one_size_are_cut_to_the_memory(self):
        given = measure.arguments([])
        bench = measure.Bench(given)
        self.assertEqual(sum(bench.groups(10**13), []), measure.SVK + measure.J2)
        self.assertEqual(max(len(group) for group in bench.groups(10**13)), 1)
        self.assertEqual(len(bench.groups(10)), 1)

    def test_cases_are_those_that_the_program_knows(self):
        source = pathlib.Path(__file__).with_name("step_case.cpp").read_text(encoding="utf-8")
        known = set(re.findall(r'word == "(\w+)"', source))
        for case in measure.SVK + measure.J2 + measure.FEW:
            self.assertLessEqual(set(case.split("+")[1:]), known)


if __name__ == "__main__":
    unittest.main()
