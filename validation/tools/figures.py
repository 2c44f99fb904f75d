"""Figures of a case and their verdicts: reference.csv, misses.csv, PASS, FAIL, MISS, INFO.

A band stands in reference.csv before a run is made.  A figure outside its band is a FAIL until it has been
studied; an entry in misses.csv then turns it into a MISS, for as long as it stays within `drift` of the
recorded value.  This file knows nothing of simulations.
"""
import csv
import dataclasses
import math
import pathlib
import re

PASS, FAIL, MISS, INFO = "PASS", "FAIL", "MISS", "INFO"
MODES = ("quick", "full")


class ContractError(Exception):
    """reference.csv, misses.csv or README.md of a case is wrong."""


def _number(text, where):
    text = text.strip()
    if not text:
        return None
    try:
        return float(text)
    except ValueError:
        raise ContractError(f"{where}: '{text}' is not a number; leave the field empty if there is none") from None


def _rows(path, columns):
    with open(path, newline="", encoding="utf-8") as file:
        lines = [line for line in file if line.strip() and not line.startswith("#")]
    reader = csv.DictReader(lines, skipinitialspace=True)
    if reader.fieldnames != columns:
        raise ContractError(f"{path}: the columns must be {','.join(columns)}; found {','.join(reader.fieldnames or [])}")
    for row in reader:
        if None in row or None in row.values():
            raise ContractError(f"{path}: the line of '{row[columns[0]]}' has not {len(columns)} fields; "
                                "quote texts with commas")
        yield {key: value.strip() for key, value in row.items()}


def _modes(text, where):
    if text == "both":
        return MODES
    if text in MODES:
        return (text,)
    raise ContractError(f"{where}: mode '{text}' is unknown; use quick, full or both")


def shown(value, digits=6):
    """Counts below 1e12 in full, other numbers rounded."""
    return f"{value:.0f}" if abs(value) < 1e12 and value == round(value) else f"{value:.{digits}g}"


@dataclasses.dataclass
class Reference:
    """One line of reference.csv: the paper's number and the band that was written down before the run."""

    quantity: str
    value: float | None
    lower: float | None
    upper: float | None
    unit: str
    source: str

    def has_band(self):
        return self.lower is not None or self.upper is not None

    def accepts(self, value):
        return (math.isfinite(value) and (self.lower is None or value >= self.lower)
                and (self.upper is None or value <= self.upper))

    def allowed(self):
        if self.lower is not None and self.upper is not None:
            return f"{shown(self.lower)}..{shown(self.upper)}"
        if self.lower is not None:
            return f">={self.lower:g}"
        return f"<={self.upper:g}" if self.upper is not None else "-"


@dataclasses.dataclass
class Miss:
    """One line of misses.csv: a studied deviation."""

    quantity: str
    value: float
    drift: float
    section: str


@dataclasses.dataclass
class Figure:
    """One printed line."""

    case: str
    quantity: str
    value: float
    verdict: str
    reference: Reference
    note: str = ""

    def columns(self):
        unit = f"[{self.reference.unit}]" if self.reference.unit else ""
        known = "-" if self.reference.value is None else shown(self.reference.value)
        value = "-" if math.isnan(self.value) else shown(self.value, 5)
        return (self.case, self.quantity + unit, value, known, self.reference.allowed(), self.verdict)


def read_references(folder, mode):
    path = pathlib.Path(folder) / "reference.csv"
    found = {}
    for row in _rows(path, ["quantity", "mode", "reference", "lower", "upper", "unit", "source", "reading"]):
        where = f"{path}: {row['quantity']}"
        if mode not in _modes(row["mode"], where):
            continue
        if row["quantity"] in found:
            raise ContractError(f"{where}: occurs twice for --{mode}")
        if not row["source"]:
            raise ContractError(f"{where}: says not where its reference or band comes from; fill in 'source'")
        found[row["quantity"]] = Reference(row["quantity"], _number(row["reference"], where), _number(row["lower"], where),
                                           _number(row["upper"], where), row["unit"], row["source"])
    return found


def _headings(readme):
    if not readme.exists():
        return set()
    return set(re.findall(r"^#+\s*(.+?)\s*$", readme.read_text(encoding="utf-8"), re.MULTILINE))


def read_misses(folder, mode):
    """Recorded misses; the section must be a heading of the case's README."""
    path = pathlib.Path(folder) / "misses.csv"
    if not path.exists():
        return {}
    headings = _headings(pathlib.Path(folder) / "README.md")
    found = {}
    for row in _rows(path, ["quantity", "mode", "value", "drift", "section"]):
        where = f"{path}: {row['quantity']}"
        if mode not in _modes(row["mode"], where):
            continue
        value, drift = _number(row["value"], where), _number(row["drift"], where)
        if value is None or drift is None or drift < 0:
            raise ContractError(f"{where}: needs the measured value and a drift tolerance >= 0")
        if row["section"] not in headings:
            raise ContractError(f"{where}: README.md has no section '{row['section']}' that explains it")
        found[row["quantity"]] = Miss(row["quantity"], value, drift, row["section"])
    return found


def judge(case, quantity, value, reference, miss):
    """The verdict on one figure."""
    value = float(value)
    if not reference.has_band():
        return Figure(case, quantity, value, INFO, reference)
    if reference.accepts(value):
        note = "is recorded as a miss and passes now: take it out of misses.csv" if miss else ""
        return Figure(case, quantity, value, PASS, reference, note)
    if miss is None:
        note = "" if math.isfinite(value) else "has no finite value"
        return Figure(case, quantity, value, FAIL, reference, note)
    if math.isfinite(value) and abs(value - miss.value) <= miss.drift:
        return Figure(case, quantity, value, MISS, reference, f"README section '{miss.section}'")
    return Figure(case, quantity, value, FAIL, reference,
                  f"recorded miss has drifted: {miss.value:g} +- {miss.drift:g} in misses.csv")


class Ledger:
    """Collects the figures of one case in one mode and notices those that never came."""

    def __init__(self, case, folder, mode):
        self.case = case
        self.references = read_references(folder, mode)
        self.misses = read_misses(folder, mode)
        unknown = sorted(set(self.misses) - set(self.references))
        if unknown:
            raise ContractError(f"{folder}/misses.csv: {', '.join(unknown)} not in reference.csv for --{mode}")
        self.figures = []

    def add(self, quantity, value):
        if quantity not in self.references:
            raise ContractError(f"{self.case}: '{quantity}' is measured but is not in reference.csv for this mode")
        if any(figure.quantity == quantity for figure in self.figures):
            raise ContractError(f"{self.case}: '{quantity}' is measured twice")
        figure = judge(self.case, quantity, value, self.references[quantity], self.misses.get(quantity))
        self.figures.append(figure)
        return figure

    def fail(self, quantity):
        """A line for something that went wrong before it could be measured; the reason is noted elsewhere."""
        self.figures.append(Figure(self.case, quantity, math.nan, FAIL, Reference(quantity, None, None, None, "", "")))

    def missing(self):
        """Figures in reference.csv that were not measured: they fail."""
        seen = {figure.quantity for figure in self.figures}
        absent = [Figure(self.case, name, math.nan, FAIL, reference, "was not measured")
                  for name, reference in self.references.items() if name not in seen]
        self.figures.extend(absent)
        return absent
