"""The command line: what is printed, what is refused and with which exit code.

Runs of decks are tested in tests/driver/run.
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
VERSION = sys.argv[2]

LISTED_TABLES = ["fields", "materials", "formulations", "groups", "status", "units"]


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.addCleanup(self.directory.cleanup)
        self.folder = pathlib.Path(self.directory.name)

    def cleave(self, *words):
        return subprocess.run([PROGRAM, *words], cwd=self.folder, text=True, capture_output=True,
                              timeout=60, check=False)

    def printed(self, *words):
        run = self.cleave(*words)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stderr, "")
        return run.stdout

    def refused(self, *words):
        run = self.cleave(*words)
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertEqual(run.stdout, "")
        self.assertTrue(run.stderr.startswith("cleave: "), run.stderr)
        return run.stderr

    def test_version(self):
        self.assertEqual(self.printed("--version"), f"cleave {VERSION}\n")

    def test_help_names_every_command(self):
        text = self.printed("--help")
        commands = ["check", "restart", "keys", "tables", "info", "export", "point", "sample", "parse"]
        for word in commands + ["--threads", "--quiet"]:
            self.assertIn(word, text)

    def test_nothing_given(self):
        self.assertIn("no deck and no command is given", self.refused())

    def test_misspelt_command(self):
        self.assertIn('Did you mean "cleave check ..."?', self.refused("chek", "deck.nml"))
        self.assertIn('Did you mean "cleave restart ..."?', self.refused("restrat"))

    def test_misspelt_option(self):
        self.assertIn("Did you mean --threads?", self.refused("--thread", "2", "deck.nml"))
        self.assertIn("Did you mean --quiet?", self.refused("check", "deck.nml", "--quite"))

    def test_bad_values_of_options(self):
        self.assertIn("--threads", self.refused("--threads", "0", "deck.nml"))
        self.assertIn("--threads", self.refused("--threads", "many", "deck.nml"))
        self.assertIn("markdown", self.refused("keys", "--format", "html"))

    def test_missing_operand(self):
        for command, operand in [("check", "DECK"), ("restart", "CHECKPOINT"), ("info", "FILE"),
                                 ("export", "RESULT"), ("point", "LAW"),
                                 ("sample", "CHECKPOINT"), ("parse", "FILE"), ("tables", "TABLE")]:
            self.assertIn(f"{operand} is required", self.refused(command))

    def test_deck_before_a_command(self):
        self.assertIn('"a.nml" stands before the command', self.refused("a.nml", "check", "b.nml"))

    def test_missing_deck_names_the_nearest(self):
        (self.folder / "branch.nml").write_text("")
        (self.folder / "other.nml").write_text("")
        for words in [("brnch.nml",), ("check", "brnch.nml"), ("branch",), ("parse", "brnch.nml")]:
            self.assertIn('Did you mean "branch.nml"?', self.refused(*words))
        self.assertIn("There are: branch.nml, other.nml.", self.refused("plate_with_hole.nml"))
        self.assertIn('There is no directory "sub".', self.refused("sub/branch.nml"))
        self.assertIn("is a directory; wanted is the deck", self.refused("check", "."))

    def test_missing_deck_without_others(self):
        self.assertIn('There is no .nml file in ".".', self.refused("brnch.nml"))

    def test_missing_checkpoint(self):
        self.assertIn('cannot find the checkpoint "run.chk"', self.refused("restart", "run.chk"))

    def test_syntax_error_in_a_deck(self):
        (self.folder / "a.nml").write_text("&run t_end = = /\n")
        self.assertIn("a.nml:1:", self.refused("check", "a.nml"))

    def test_garbage_as_a_deck(self):
        (self.folder / "a.nml").write_bytes(bytes(range(256)) * 50)
        self.refused("check", "a.nml")

    def test_keys_lists_everything(self):
        listing, markdown = self.printed("keys"), self.printed("keys", "--format", "markdown")
        names = self.printed("keys", "--format", "names").split()
        self.assertGreater(len(names), 80)
        self.assertEqual(len(names), len(set(names)))
        for name in names:
            group, key = name.split(".")
            self.assertIn(f"&{group}  (", listing)
            self.assertIn(f"  {key} ", listing)
            self.assertIn(f"## `&{group}`", markdown)
            self.assertIn(f"| `{key}` |", markdown)

    def test_keys_of_a_group_and_of_a_key(self):
        self.assertTrue(self.printed("keys", "run").startswith("&run  (once)"))
        self.assertEqual(self.printed("keys", "RUN.T_END"), self.printed("keys", "run.t_end"))
        self.assertIn("real number [s], > 0; required", self.printed("keys", "run.t_end"))
        self.assertIn("with law = 'svk'", self.printed("keys", "material"))

    def test_unknown_keys(self):
        self.assertIn("did you mean &body?", self.refused("keys", "bdy"))
        self.assertIn('did you mean "t_end"?', self.refused("keys", "run.t_ned"))
        self.assertIn("keys of this name: run.t_end", self.refused("keys", "t_end"))

    def test_markdown_tables_are_regular(self):
        texts = [self.printed("tables", table, "--format", "markdown") for table in LISTED_TABLES]
        for text in texts + [self.printed("keys", "--format", "markdown")]:
            columns = 0
            for line in text.splitlines():
                bars = line.replace("\\|", "").count("|")
                columns = 0 if not bars else columns or bars
                self.assertEqual(bars, columns, line)

    def test_tables(self):
        self.assertIn("CLEAVE_BAD_SIMPLEX", self.printed("tables", "status"))
        self.assertIn("svk", self.printed("tables", "materials"))
        self.assertIn("cbm", self.printed("tables", "formulations"))
        self.assertIn("viscosity", self.printed("tables", "groups"))
        self.assertIn("displacement", self.printed("tables", "fields"))
        self.assertIn('did you mean "fields"?', self.refused("tables", "field"))

    def test_parse_prints_json(self):
        (self.folder / "any.nml").write_text("&Anything a%b(2) = 2*1.5, 'it''s' /\n")
        tree = json.loads(self.printed("parse", "any.nml"))
        assignment = tree["groups"][0]["assignments"][0]
        self.assertEqual(tree["groups"][0]["name"], "anything")
        self.assertEqual(assignment["name"], "a%b(2)")
        self.assertEqual(assignment["values"], [1.5, 1.5, "it's"])

    def test_info_refuses_other_files(self):
        (self.folder / "notes.txt").write_text("no result\n")
        self.assertIn("notes.txt", self.refused("info", "notes.txt"))
        (self.folder / "empty.nc").write_text("")
        self.assertIn("empty.nc", self.refused("info", "empty.nc"))

    def test_info_lists_and_verifies_checkpoints(self):
        deck = ("&run units='other' t_end=2 time_step=0.5 /\n"
                "&lattice type='square' spacing=1 size=2,2,0 /\n"
                "&body kinematics='plane_stress' material='m' /\n"
                "&material name='m' law='svk' E=1 nu=0.25 rho=1 /\n&checkpoint every_steps=2 /\n")
        (self.folder / "case.nml").write_text(deck)
        self.printed("--quiet", "case.nml")
        self.assertEqual(self.printed("info", ".").count(" verified\n"), 2)
        self.assertEqual(self.printed("info", "--deck", "case.4.checkpoint.nc"), deck)
        self.assertIn("after step 4 of 4, time 2.0", self.printed("info", "case.4.checkpoint.nc"))
        for name in ("case.4.checkpoint.nc", "case.exo", "case.history.nc", "."):
            self.printed("info", "--verify", name)
        broken = self.folder / "case.4.checkpoint.nc"
        with broken.open("r+b") as file:
            file.seek(-3, 2)
            file.write(b"x")
        run = self.cleave("info", "--verify", broken.name)
        self.assertEqual(run.returncode, 1)
        self.assertIn("is damaged", run.stdout)
        self.assertEqual(self.cleave("info", "--verify", ".").returncode, 1)
        self.assertIn("broken: ", self.printed("info", "."))
        self.refused("info", "--deck", "case.exo")

    def test_restart_says_what_a_deck_changes(self):
        deck = ("&run units='other' name='case' t_end={} time_step=0.5 /\n"
                "&lattice type='square' spacing=1 size=2,2,0 /\n"
                "&body kinematics='plane_stress' material='m' /\n"
                "&material name='m' law='svk' E={} nu=0.25 rho=1 /\n")
        (self.folder / "case.nml").write_text(deck.format(2, 1))
        (self.folder / "longer.nml").write_text(deck.format(3, 1))
        (self.folder / "stiffer.nml").write_text(deck.format(3, 2))
        self.printed("--quiet", "case.nml")
        why = self.refused("restart", ".", "--deck", "stiffer.nml")
        self.assertIn("stiffer.nml:4:30: &material 'm', key E: the checkpoint has 1.0, this deck 2.0", why)
        said = self.printed("restart", ".", "--deck", "longer.nml")
        self.assertTrue(said.startswith("longer.nml: changes to the deck of ./case.4.checkpoint.nc:\n"
                                        "  &run t_end: 2.0 -> 3.0\ncleave "), said)
        listed = self.printed("keys", "--restart")
        self.assertIn("t_end", listed)
        self.assertNotIn("time_step", listed)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
