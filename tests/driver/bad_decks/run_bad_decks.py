"""Every deck of this folder has one mistake, and says in its first lines what must be said:

    ! expect: text that must stand in the answer (several lines: all of them, in this order)

`cleave check` must refuse each with exit code 2, within a second (sanitizers: more), and never crash.
"""

import pathlib
import subprocess
import sys
import time
import unittest

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
FOLDER = pathlib.Path(sys.argv[2]).resolve()
MARK = "! expect: "
LONGEST = 10.0  # s; measured 0.02: wide because test machines are shared


def expected_texts(deck):
    lines = deck.read_text(encoding="utf-8", errors="replace").splitlines()
    return [line[len(MARK):].rstrip() for line in lines if line.startswith(MARK)]


class BadDecks(unittest.TestCase):
    def test_every_deck(self):
        decks = sorted(FOLDER.glob("*.nml"))
        self.assertGreater(len(decks), 20)
        for deck in decks:
            with self.subTest(deck=deck.name):
                self.check_deck(deck)

    def check_deck(self, deck):
        expected = expected_texts(deck)
        self.assertTrue(expected, "the deck does not say what is expected")
        start = time.monotonic()
        run = subprocess.run([PROGRAM, "check", deck.name], cwd=FOLDER, text=True,
                             capture_output=True, timeout=60, check=False)
        self.assertLess(time.monotonic() - start, LONGEST)
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertTrue(run.stderr.startswith("cleave: "), run.stderr)
        at = 0
        for text in expected:
            found = run.stderr.find(text, at)
            self.assertGreaterEqual(found, 0, f"not said: {text}\nsaid: {run.stderr}")
            at = found + len(text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
