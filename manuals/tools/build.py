"""Builds the manuals: generates the reference pages, then runs Sphinx with warnings as errors.

    build.py --program CLEAVE --output FOLDER [--sphinx sphinx-build]

FOLDER/html/index.html is the result.
"""
import argparse
import pathlib
import subprocess
import sys

import c_interface

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEADER = ROOT / "kernels/include/cleave/cleave.h"
TABLES = ("fields", "materials", "formulations", "groups", "status", "units")
COMMANDS = ("check", "restart", "keys", "tables", "info", "export", "parse")


def generate(program, folder):
    """Writes the pages that `<!-- generated: NAME -->` asks for."""
    def output(*arguments):
        return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout
    pages = {name: output("tables", name, "--format", "markdown") for name in TABLES}
    pages["keys"] = output("keys", "--format", "markdown")
    pages["restart_keys"] = output("keys", "--restart", "--format", "markdown")
    pages["c_interface"] = c_interface.page(HEADER.read_text(encoding="utf-8"))
    texts = [output("--help")] + [output(command, "--help") for command in COMMANDS]
    titles = ["cleave"] + [f"cleave {command}" for command in COMMANDS]
    pages["help"] = "\n".join(f"## {title}\n\n```text\n{text.strip()}\n```\n" for title, text in zip(titles, texts))
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in pages.items():
        (folder / f"{name}.md").write_text(text, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description="Builds the HTML manuals.")
    parser.add_argument("--program", required=True, help="the cleave executable")
    parser.add_argument("--output", required=True, type=pathlib.Path, help="folder for generated pages and HTML")
    parser.add_argument("--sphinx", default="sphinx-build", help="the sphinx-build command")
    given = parser.parse_args()
    generated = given.output.resolve() / "generated"
    generate(given.program, generated)
    return subprocess.run([given.sphinx, "-q", "-W", "--keep-going", "-b", "html", "-d", given.output / "doctrees",
                           "-D", f"cleave_generated={generated}", ROOT / "manuals", given.output / "html"],
                          check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
