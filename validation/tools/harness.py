"""The command `validation/run`: finds cases, does their runs, judges their figures, prints the table.

A case is a folder with check.py, which offers
    runs(mode)             the simulations it needs, a list of simulation.Run
    check(case)            measures figures:  case.figure(quantity, value)
    pictures(case, folder) optional: writes PNG files and returns [(file name, caption)]
    skip(case)             optional: a reason why it cannot run here, None if it can; only for what it needs from outside
and reference.csv (see figures.py).  Physics stays in the cases; this file has none.
"""
import argparse
import concurrent.futures
import dataclasses
import importlib.util
import os
import pathlib
import sys
import traceback

from . import figures, report, simulation

ROOT = pathlib.Path(__file__).resolve().parents[2]


@dataclasses.dataclass
class Options:
    """What the command line asks for, resolved."""

    mode: str
    cleave: str
    work: pathlib.Path
    threads: int
    jobs: int
    evaluate: bool
    report: pathlib.Path | None


class Case:
    """A case in one mode: its runs' results by name, and where its figures go."""

    def __init__(self, folder, mode):
        self.folder, self.name, self.mode = pathlib.Path(folder), pathlib.Path(folder).name, mode
        self.results, self.notes, self.pictures, self.skipped = {}, [], [], None
        self.cleave, self.work, self.jobs, self.evaluate = None, None, 1, False
        self.module = _load(self.folder / "check.py", self.name)
        self.ledger = figures.Ledger(self.name, self.folder, mode)

    def prepare(self, options):
        """What cases need that run other programs themselves."""
        self.cleave, self.work, self.jobs = options.cleave, options.work / self.name, options.jobs
        self.evaluate = options.evaluate
        self.skipped = getattr(self.module, "skip", lambda case: None)(self)

    @property
    def full(self):
        return self.mode == "full"

    def figure(self, quantity, value):
        return self.ledger.add(quantity, value)

    def title(self):
        readme = self.folder / "README.md"
        return readme.read_text(encoding="utf-8").splitlines()[0].lstrip("# ") if readme.exists() else ""


def _load(path, name):
    """check.py as a module; a case may have further files beside it."""
    specification = importlib.util.spec_from_file_location(f"validation_{name.replace('-', '_')}", path)
    module = importlib.util.module_from_spec(specification)
    sys.modules[specification.name] = module
    specification.loader.exec_module(module)
    return module


def find_cases(root):
    return sorted(path.parent.name for path in pathlib.Path(root).glob("*/check.py"))


def _progress(text):
    print(text, file=sys.stderr, flush=True)


def _do_run(case, run, options, label):
    folder = options.work / case.name / run.name
    if options.evaluate:
        if not folder.exists():
            raise simulation.RunError(f"no earlier run in {folder}; run without --evaluate")
        return simulation.Result(run, folder)
    _progress(f"{label} ...")
    result = simulation.execute(run, case.folder, folder, options.cleave, options.threads, label if options.jobs == 1 else None)
    _progress(f"{label} {result.wall:.1f} s")
    return result


def _attempt(case, run, options, label):
    """The result, or None; a failed run is noted and its figures will be missing too."""
    try:
        return _do_run(case, run, options, label)
    except Exception as error:  # a broken run must not end the others
        case.notes.append(f"{case.name} run {run.name}: {error}")
        case.ledger.fail(f"run_{run.name}")
        _progress(f"{label} failed")
        return None


def do_case(case, options):
    """Runs, measures, judges; prints the figures of the case."""
    case.prepare(options)
    if case.skipped:
        print(f"{case.name} skipped: {case.skipped}", flush=True)
        return
    runs = case.module.runs(case.mode)
    labels = [f"[{number}/{len(runs)}] {case.name} {run.name}" for number, run in enumerate(runs, 1)]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        done = list(pool.map(lambda pair: _attempt(case, pair[0], options, pair[1]), zip(runs, labels)))
    case.results = {run.name: result for run, result in zip(runs, done) if result is not None}
    try:
        case.module.check(case)
    except Exception as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        case.notes.append(f"{case.name} check.py stopped ({pathlib.Path(place.filename).name}:{place.lineno}): "
                          f"{type(error).__name__}: {error}")
    case.ledger.missing()
    print_table(case.ledger.figures)
    for figure in case.ledger.figures:
        if figure.note:
            case.notes.append(f"{case.name} {figure.quantity} {figure.note}")


def print_table(rows):
    for figure in rows:
        case, quantity, value, reference, allowed, verdict = figure.columns()
        print(f"{case:14s}  {quantity:34s}  {value:>11s}  {reference:>9s}  {allowed:>19s}  {verdict}", flush=True)


def draw(case, folder):
    """Pictures for the report; a picture that fails is a note, never a verdict."""
    maker = getattr(case.module, "pictures", None)
    if maker is None or case.skipped:
        return
    folder.mkdir(parents=True, exist_ok=True)
    try:
        case.pictures = [(pathlib.Path(case.name) / name, caption) for name, caption in maker(case, folder)]
    except Exception as error:
        case.notes.append(f"{case.name} pictures: {type(error).__name__}: {error}")


def parse(arguments):
    parser = argparse.ArgumentParser(prog="validation/run", description="Runs validation cases and prints one line per figure: "
                                     "case quantity value reference allowed PASS|FAIL|MISS|INFO.")
    parser.add_argument("case", nargs="*", help="cases; none: all")
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--quick", action="store_true", help="coarse, about a minute a case (default)")
    size.add_argument("--full", action="store_true", help="the paper's resolution")
    parser.add_argument("--strict", action="store_true", help="a recorded miss fails too")
    parser.add_argument("--list", action="store_true", help="list the cases and stop")
    parser.add_argument("--report", metavar="DIR", help="write an HTML page with pictures there")
    parser.add_argument("--cleave", metavar="PATH", help="the executable; else $CLEAVE, else build/release/bin/cleave")
    parser.add_argument("--work", metavar="DIR", default=str(ROOT / "build/validation"), help="where runs are made")
    parser.add_argument("--jobs", type=int, default=min(2, len(os.sched_getaffinity(0))),
                        help="runs at the same time (default: 2, or 1 on one core)")
    parser.add_argument("--threads", type=int, default=1, help="threads of a run (default 1)")
    parser.add_argument("--evaluate", action="store_true", help="judge the results of earlier runs, run nothing")
    parser.add_argument("--cases", metavar="DIR", default=str(ROOT / "validation"), help="folder of the cases")
    return parser, parser.parse_args(arguments)


def select(parser, given, root):
    known = find_cases(root)
    unknown = [name for name in given if name not in known]
    if unknown:
        parser.error(f"no case {', '.join(unknown)} in {root}; the cases are {', '.join(known) or '(none)'}")
    return given or known


def list_cases(names, root, mode):
    for name in names:
        case = Case(pathlib.Path(root) / name, mode)
        runs, expected = len(case.module.runs(mode)), len(case.ledger.references)
        print(f"{name:16s} {case.title()} ({runs} runs, {expected} figures in --{mode})")


def summarise(cases, strict):
    """The closing lines and the exit status."""
    for case in cases:
        for note in case.notes:
            print("note:", note)
    verdicts = [figure.verdict for case in cases for figure in case.ledger.figures]
    missed, failed = verdicts.count(figures.MISS), verdicts.count(figures.FAIL)
    print(f"{missed} missed")
    print(f"{verdicts.count(figures.PASS)} passed, {failed} failed", flush=True)
    return 1 if failed or (strict and missed) else 0


def main(arguments):
    parser, given = parse(arguments)
    mode = "full" if given.full else "quick"
    try:
        names = select(parser, given.case, given.cases)
        if given.list:
            list_cases(names, given.cases, mode)
            return 0
        cases = [Case(pathlib.Path(given.cases) / name, mode) for name in names]
        options = Options(mode, simulation.find_cleave(given.cleave, ROOT), pathlib.Path(given.work).resolve() / mode,
                          max(1, given.threads), max(1, given.jobs), given.evaluate,
                          pathlib.Path(given.report).resolve() if given.report else None)
    except (figures.ContractError, simulation.RunError) as error:
        print(f"validation/run: {error}", file=sys.stderr)
        return 2
    for case in cases:
        do_case(case, options)
    if options.report:
        for case in cases:
            draw(case, options.report / case.name)
        print("report:", report.write(options.report, cases, mode))
    return summarise(cases, given.strict)
