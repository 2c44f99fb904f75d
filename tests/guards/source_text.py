"""Rules of the house that a search can check: printing, exits, random numbers, floating-point flags,
leftover words, file length, paths of one machine, links in Markdown."""
import posixpath
import re

from tree import SCRIPT, SOURCE

LONGEST_FILE = 700  # lines; aim at 400

QUIET = ("kernels/", "io/", "tests/kernels/", "tests/properties/", "tests/abi/", "tests/io/", "tests/driver/",
         "tests/support/")
LIBRARIES = ("kernels/", "io/")
# On the host's side of the interface: CalculiX learns of a wrong deck in no other way.
SPEAKERS = ("kernels/adapters/calculix/law.c",)
SEED = "use a generator with a written seed, so that a failure can be repeated"

# (pattern, patterns of paths, folders, comments too?, complaint)
RULES = [
    (r"std::(cout|cerr|clog|print|println)\b|\b(printf|puts|putchar|perror)\s*\(|\bfprintf\s*\(", SOURCE, QUIET, False,
     "libraries and tests do not print; return a status or throw, assert instead of showing"),
    (r"\b(std::)?(exit|abort|_Exit|quick_exit|terminate)\s*\(|\bassert\s*\(|\bsignal\s*\((?!\w+, SIG_DFL)", SOURCE, LIBRARIES, False,
     "a library never ends its host; return a status or throw"),
    (r"\bstd::random_device\b|\bs?rand\s*\(|std::(mt19937(_64)?|minstd_rand0?|default_random_engine)\s+\w+\s*(;|\{\s*\})",
     SOURCE, (), False, "seed the random engine with a written number, so that a failure can be repeated"),
    (r"default_rng\(\s*\)|\brandom\.(random|uniform|randint|choice|shuffle)\(", SCRIPT, (), False, SEED),
    (r"-f" r"fast-math|-O" r"fast|-f(associative|unsafe|finite|reciprocal)-math|omp\s+atomic|reduction\(|"
     r"std::atomic<\s*(double|float)", SOURCE + ("*CMakeLists.txt", "*.cmake", "*.json"), (), True,
     "sums must keep their order, whatever the threads and flags"),
    (r"\b(strtod|atof|stod|stof|setlocale|sscanf)\s*\(", SOURCE, ("kernels/", "io/", "driver/"), False,
     "numbers are read and written without the locale; use std::from_chars and std::to_chars"),
    (r"\b(TO" r"DO|FIX" r"ME|HA" r"CK|XX" r"X)\b", (), (), True, "finish it, or open an issue"),
    (r"(?<![\w.])/(home|root|tmp|work|Users)/", (), (), True,
     "a path of one machine; use the build folder or a path relative to the repository"),
]


def check(tree):
    complaints = []
    for pattern, kinds, folders, comments, remedy in RULES:
        paths = [path for path in tree.paths(*kinds, under=folders) if not path.startswith("tests/guards/")]
        if folders in (QUIET, LIBRARIES):
            paths = [path for path in paths if path not in SPEAKERS]
        if folders is QUIET:  # what a program of its own prints is its product
            paths = [path for path in paths if not re.search(r"\bint main\(", tree.text(path))]
        code = [path for path in paths if path.endswith((".c", ".h", ".cpp", ".hpp", ".def"))]
        other = [path for path in paths if path not in code]
        for path, line, match in [*tree.find(pattern, code, code_only=not comments), *tree.find(pattern, other)]:
            if remedy == SEED and re.search(r"\bRandom\(|\bseed\(", tree.text(path)):
                continue
            complaints.append(f"{path}:{line}: '{match.group(0).strip()}': {remedy}")
    return complaints + _lengths(tree) + _links(tree) + _decks(tree)


def _lengths(tree):
    return [f"{path}: {len(tree.lines(path))} lines; more than {LONGEST_FILE} hide more than one purpose, split it"
            for path in tree.paths(*SOURCE, "*.py") if len(tree.lines(path)) > LONGEST_FILE]


def _links(tree):
    """Relative links and pictures of Markdown files lead to files of the repository."""
    complaints = []
    for path, line, match in tree.find(r"\]\(([^)#:\s]+)(#[^)]*)?\)", tree.paths("*.md")):
        target = posixpath.normpath(posixpath.join(posixpath.dirname(path), match.group(1)))
        known = tree.has(target) or tree.paths(under=target.rstrip("/") + "/")
        if not known and re.search(r"\.(md|nml|geo|py|hpp|h|def|csv|txt)$", target):
            complaints.append(f"{path}:{line}: the link to {match.group(1)} leads nowhere")
    return complaints


def _decks(tree):
    """A deck shown in a Markdown file is a file of manuals/decks, which the tests run."""
    decks = {tree.text(path).strip() for path in tree.paths("manuals/decks/*.nml")}
    complaints = []
    for path in tree.paths("*.md"):
        for match in re.finditer(r"(?m)^```\w*\n(&.*?)^```", tree.text(path), flags=re.S):
            if match.group(1).strip() not in decks:
                line = tree.text(path).count("\n", 0, match.start()) + 1
                complaints.append(f"{path}:{line}: this deck is no file of manuals/decks; make it one, so that it is run")
    return complaints
