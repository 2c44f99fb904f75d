"""Runs one guard over the repository: guard.py NAME [ROOT]. Ends with 1 and the complaints if it has any."""
import importlib
import os
import sys

from tree import Tree


def main(arguments):
    name = arguments[0]
    root = arguments[1] if len(arguments) > 1 else os.path.join(os.path.dirname(__file__), "..", "..")
    tree = Tree.from_directory(os.path.abspath(root))
    if not tree.paths():
        print(f"{root}: no files found")
        return 1
    complaints = importlib.import_module(name).check(tree)
    for complaint in complaints:
        print(complaint)
    print(f"{name}: {len(complaints)} complaints")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
