"""The contract of validation/run, with a made-up case and a made-up cleave: verdicts, exit status, errors."""
import os
import pathlib
import stat
import subprocess
import sys
import tempfile
import unittest

RUN = pathlib.Path(__file__).resolve().parents[2] / "run"

CHECK = """
from tools.simulation import Run

def runs(mode):
    return [Run("one", "deck.nml", {"run.t_end": 2.5})]

def check(case):
    if "boom" in VALUES:
        raise ValueError("the crack is lost")
    for quantity, value in VALUES.items():
        case.figure(quantity, value)

def pictures(case, folder):
    (folder / "one.png").write_bytes(b"png")
    return [("one.png", "a caption")]

"""
HEAD = "quantity,mode,reference,lower,upper,unit,source,reading\n"
MISSES = "quantity,mode,value,drift,section\n"
DECK = "&run\n  t_end = 1.0, units = 'SI'\n/\n"


class Contract(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.root = pathlib.Path(holder.name)
        self.case = self.root / "cases" / "made-up"
        self.case.mkdir(parents=True)
        (self.case / "deck.nml").write_text(DECK)
        (self.case / "README.md").write_text("# Made up\n\n## Why it is off\n")
        self.cleave("exit 0")

    def cleave(self, script):
        self.executable = self.root / "cleave"
        self.executable.write_text(f"#!/bin/sh\n{script}\n")
        self.executable.chmod(self.executable.stat().st_mode | stat.S_IXUSR)

    def write(self, values, references, misses=None):
        (self.case / "check.py").write_text(CHECK + f"nan = float('nan')\nVALUES = {values!r}\n")
        (self.case / "reference.csv").write_text(HEAD + references)
        if misses is not None:
            (self.case / "misses.csv").write_text(MISSES + misses)

    def run_it(self, *arguments, cleave=True):
        command = [sys.executable, str(RUN), "--cases", str(self.root / "cases"), "--work", str(self.root / "work"), *arguments]
        environment = {name: value for name, value in os.environ.items() if name != "CLEAVE"}
        if cleave:
            command += ["--cleave", str(self.executable)]
        return subprocess.run(command, capture_output=True, text=True, env=environment)

    def line(self, done, quantity):
        lines = [line.split() for line in done.stdout.splitlines() if line.startswith("made-up")]
        found = [words for words in lines if words[1].startswith(quantity)]
        self.assertEqual(len(found), 1, done.stdout + done.stderr)
        return found[0]

    def test_a_figure_inside_its_band_passes(self):
        self.write({"speed": 1.5}, "speed,both,1.6,1,2,m/s,paper,text\n")
        done = self.run_it()
        self.assertEqual(self.line(done, "speed"), ["made-up", "speed[m/s]", "1.5", "1.6", "1..2", "PASS"])
        self.assertEqual(done.stdout.splitlines()[-2:], ["0 missed", "1 passed, 0 failed"])
        self.assertEqual(done.returncode, 0)

    def test_a_case_that_cannot_run_here_says_why(self):
        self.write({"speed": 1.5}, "speed,both,1.6,1,2,m/s,paper,text\n")
        with open(self.case / "check.py", "a") as file:
            file.write("\ndef skip(case):\n    return f'no program beside {case.cleave}, for {case.work.name}'\n")
        done = self.run_it("--report", str(self.root / "page"))
        self.assertIn(f"made-up skipped: no program beside {self.executable}, for made-up\n", done.stdout)
        self.assertEqual(done.stdout.splitlines()[-2:], ["0 missed", "0 passed, 0 failed"])
        self.assertEqual(done.returncode, 0)
        self.assertTrue((self.root / "page" / "index.html").exists())

    def test_a_figure_outside_its_band_fails(self):
        self.write({"speed": 2.5}, "speed,both,1.6,1,2,m/s,paper,text\n")
        done = self.run_it()
        self.assertEqual(self.line(done, "speed")[-1], "FAIL")
        self.assertEqual(done.stdout.splitlines()[-1], "0 passed, 1 failed")
        self.assertEqual(done.returncode, 1)

    def test_not_a_number_fails(self):
        self.write({"speed": float("nan")}, "speed,both,1.6,,2,m/s,paper,text\n")
        self.assertEqual(self.line(self.run_it(), "speed")[-1], "FAIL")

    def test_a_figure_without_band_is_information(self):
        self.write({"speed": 7}, "speed,both,1.6,,,m/s,paper,text\n")
        done = self.run_it("--strict")
        self.assertEqual(self.line(done, "speed")[-2:], ["-", "INFO"])
        self.assertEqual((done.stdout.splitlines()[-1], done.returncode), ("0 passed, 0 failed", 0))

    def test_counts_are_printed_in_full(self):
        self.write({"triples": 19786146480}, "triples,both,19786146480,19786146480,19786146480,,paper,text\n")
        self.assertEqual(self.line(self.run_it(), "triples"),
                         ["made-up", "triples", "19786146480", "19786146480", "19786146480..19786146480", "PASS"])
        self.write({"triples": 19786146481}, "triples,both,19786146480,19786146480,19786146480,,paper,text\n")
        self.assertEqual(self.line(self.run_it(), "triples")[-1], "FAIL")

    def test_a_studied_miss_is_a_miss_and_fails_only_when_strict(self):
        self.write({"speed": 2.5}, "speed,both,1.6,1,2,,paper,text\n", "speed,both,2.45,0.1,Why it is off\n")
        done = self.run_it()
        self.assertEqual(self.line(done, "speed")[-1], "MISS")
        self.assertEqual(done.stdout.splitlines()[-2:], ["1 missed", "0 passed, 0 failed"])
        self.assertEqual(done.returncode, 0)
        self.assertEqual(self.run_it("--strict").returncode, 1)

    def test_a_miss_that_drifts_fails(self):
        self.write({"speed": 2.6}, "speed,both,1.6,1,2,,paper,text\n", "speed,both,2.45,0.1,Why it is off\n")
        done = self.run_it()
        self.assertEqual((self.line(done, "speed")[-1], done.returncode), ("FAIL", 1))
        self.assertIn("drifted", done.stdout)

    def test_a_recorded_miss_that_passes_is_reported(self):
        self.write({"speed": 1.9}, "speed,both,1.6,1,2,,paper,text\n", "speed,both,2.45,0.1,Why it is off\n")
        done = self.run_it("--strict")
        self.assertEqual((self.line(done, "speed")[-1], done.returncode), ("PASS", 0))
        self.assertIn("take it out of misses.csv", done.stdout)

    def test_a_miss_needs_its_section(self):
        self.write({"speed": 2.5}, "speed,both,1.6,1,2,,paper,text\n", "speed,both,2.45,0.1,No such section\n")
        done = self.run_it()
        self.assertEqual(done.returncode, 2)
        self.assertIn("has no section 'No such section'", done.stderr)

    def test_a_figure_that_was_not_measured_fails(self):
        self.write({}, "speed,both,1.6,,,m/s,paper,text\n")
        done = self.run_it()
        self.assertEqual((self.line(done, "speed")[-1], done.returncode), ("FAIL", 1))

    def test_modes_choose_the_band(self):
        self.write({"speed": 1.5}, "speed,quick,1.6,1,2,,paper,text\nspeed,full,1.6,1.55,2,,paper,text\n")
        self.assertEqual(self.line(self.run_it("--quick"), "speed")[-1], "PASS")
        self.assertEqual(self.line(self.run_it("--full"), "speed")[-1], "FAIL")

    def test_a_failed_run_is_named(self):
        self.write({"speed": 1.5}, "speed,both,1.6,1,2,,paper,text\n")
        self.cleave("echo 'deck.nml:2: no such key'; exit 2")
        done = self.run_it()
        self.assertIn("run one: cleave ended with 2", done.stdout)
        self.assertEqual((self.line(done, "run_one")[-1], done.returncode), ("FAIL", 1))
        self.assertIn("no such key", done.stdout)

    def test_a_broken_check_fails_its_figures(self):
        self.write({"boom": 1}, "speed,both,1.6,1,2,,paper,text\n")
        done = self.run_it()
        self.assertEqual((self.line(done, "speed")[-1], done.returncode), ("FAIL", 1))
        self.assertIn("ValueError: the crack is lost", done.stdout)

    def test_the_run_gets_its_own_deck(self):
        self.write({}, "")
        self.run_it()
        self.assertEqual((self.root / "work/quick/made-up/one/one.nml").read_text(), DECK.replace("1.0", "2.5"))

    def test_a_missing_executable_is_said_clearly(self):
        self.write({}, "")
        done = self.run_it("--cleave", str(self.root / "nowhere"), cleave=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("no executable at", done.stderr)
        self.assertIn("CLEAVE", done.stderr)

    def test_an_unknown_case_lists_the_known(self):
        self.write({}, "")
        done = self.run_it("mad-up")
        self.assertEqual(done.returncode, 2)
        self.assertIn("the cases are made-up", done.stderr)

    def test_a_wrong_table_is_refused(self):
        self.write({"speed": 1.5}, "speed,both,fast,1,2,,paper,text\n")
        done = self.run_it()
        self.assertEqual(done.returncode, 2)
        self.assertIn("'fast' is not a number", done.stderr)

    def test_list(self):
        self.write({}, "speed,both,1.6,1,2,,paper,text\n")
        done = self.run_it("--list", cleave=False)
        self.assertEqual(done.returncode, 0)
        self.assertEqual(done.stdout.split("(")[0].split(), ["made-up", "Made", "up"])

    def test_report(self):
        self.write({"speed": 1.5}, "speed,both,1.6,1,2,m/s,paper <1>,text\n")
        self.run_it("--report", str(self.root / "page"))
        page = (self.root / "page/index.html").read_text()
        self.assertIn("paper &lt;1&gt;", page)
        self.assertIn('src="made-up/one.png"', page)
        self.assertTrue((self.root / "page/made-up/one.png").exists())


if __name__ == "__main__":
    unittest.main()
