"""The files of write_sample_files.cpp, written anew for one check."""

import contextlib
import subprocess
import sys
import tempfile


@contextlib.contextmanager
def sample_files():
    """A folder with the files; the program that writes them is the first argument."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv[1], folder], check=True)
        yield folder
