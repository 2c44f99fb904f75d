"""Makes the table of the records that measure.py has collected: medians with the lowest and the highest, as text that reads
well in a terminal and is Markdown. Nothing is measured here."""
import statistics

import traffic

BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"


def put_between_marks(page, text):
    head, rest = page.split(BEGIN)
    _, tail = rest.split(END)
    return f"{head}{BEGIN}\n{text}\n{END}{tail}"


def text(records):
    parts = [heading(records), machine(records), steps(records), prices(records), memory(records), irregular(records), mapping(records), lammps(records)]
    return "\n\n".join(part for part in parts if part)


def select(records, **wanted):
    return [r for r in records if all(r.get(key) == value for key, value in wanted.items())]


def values_of(records, key):
    """What the records have under the key, each once, in order of appearance."""
    return list(dict.fromkeys(r[key] for r in records if key in r))


class Measured:
    """Median, lowest and highest of some numbers."""

    def __init__(self, numbers):
        self.median, self.low, self.high = statistics.median(numbers), min(numbers), max(numbers)

    def show(self, scale):
        return f"{short(self.median / scale)} ({short(self.low / scale)}–{short(self.high / scale)})"


def measured(records, key, turn=lambda number: number):
    numbers = [turn(r[key]) for r in records if r.get(key) is not None]
    return Measured(numbers) if numbers else None


def short(number):
    """Three digits."""
    if number == 0:
        return "0"
    text_ = f"{number:.3g}"
    return f"{float(text_):.0f}" if "e" in text_ else text_


def grid(title, columns, rows):
    """A Markdown table whose columns line up."""
    if not rows:
        return ""
    width = [max(len(str(line[k])) for line in [columns, *rows]) for k in range(len(columns))]
    first_number = 1
    def show(line):
        return "| " + " | ".join(str(c).ljust(w) if k < first_number else str(c).rjust(w) for k, (c, w) in enumerate(zip(line, width))) + " |"
    rule = "|" + "|".join("-" * (w + 2) if k < first_number else "-" * (w + 1) + ":" for k, w in enumerate(width)) + "|"
    return "\n".join([f"*{title}*", "", show(columns), rule, *map(show, rows)])


def heading(records):
    host, build, end = (next(iter(select(records, kind=kind)), None) for kind in ("host", "build", "end"))
    if host is None:
        return ""
    words = [f"Measured on {host['date']} ({host['mode']})", f"{host['cpu']}, {host['cores']} cores, {host['system']}"]
    if build:
        words.append(f"GCC {build['compiler']}, Cleave {build['version']}")
    words.append(f"load of the machine before {host['load']:.1f}" + (f", the run took {end['seconds'] / 60:.0f} minutes" if end else ""))
    return "; ".join(words) + "."


def threads_of(records):
    return sorted(set(values_of(records, "threads")))


def head_of(threads, word):
    return [f"{word}{n} thread{'s' if n > 1 else ''}" for n in threads]


def machine(records):
    mine = select(records, part="machine")
    threads = threads_of(mine)
    rows = []
    for name in [None, *values_of(mine, "name")]:
        cells = []
        for n in threads:
            found = select(mine, kind="triad", threads=n) if name is None else select(mine, name=name, threads=n)
            m = measured(found, "bytes_per_second" if name is None else "operations_per_second")
            cells.append(m.show(1e9) if m else "")
        rows.append(["STREAM triad, GB/s" if name is None else f"multiply and add, {name}, GFLOP/s", *cells])
    return grid("The machine", ["", *head_of(threads, "")], rows) if mine else ""


def rate(found, particles):
    return measured(found, "seconds_per_step", lambda seconds: particles / seconds)


def steps(records):
    """A row a case: rates, speed-up, modelled traffic, and the share of the rate that the triad of the same turns would allow."""
    mine = select(records, part="step")
    threads = threads_of(select(mine, kind="step"))
    rows = []
    for dimension in values_of(mine, "dimension"):
        for wanted in values_of(select(mine, dimension=dimension), "wanted"):
            these = select(mine, dimension=dimension, wanted=wanted)
            for model in select(these, kind="model"):
                rows.append([f"{dimension}D {size_of(wanted)} {model['case']}", *step_cells(these, model, threads)])
    columns = ["step of", *head_of(threads, "M/s, "), "speed-up", "B per step", *head_of(threads, "% of triad, "), "broken a step"]
    return grid("The step: millions of particle-steps per second", columns, rows)


def size_of(particles):
    return f"{particles:.0e}".replace("e+0", "e")


def step_cells(records, model, threads):
    case, particles = model["case"], model["particles"]
    moved = traffic.bytes_per_step(case, model["dimension"], 2 * model["bonds"] / particles)
    found = {n: select(records, kind="step", case=case, threads=n) for n in threads}
    rates = {n: rate(found[n], particles) for n in threads}
    bound = {n: measured(select(records, kind="triad", threads=n), "bytes_per_second").median / moved for n in threads}
    broken = measured([r for n in threads for r in found[n]], "broken_per_step").median
    speed_up = f"{rates[threads[-1]].median / rates[threads[0]].median:.2f}" if len(threads) > 1 else ""
    return [*(rates[n].show(1e6) for n in threads), speed_up, f"{moved:.0f}",
            *(f"{100 * rates[n].median / bound[n]:.0f}" for n in threads), short(broken) if broken else ""]


# (what, with it, without it)
PRICES = [("fracture on, bonds far from breaking", "svk+fracture", "svk"), ("every bond looked at in every step", "svk+search", "svk"),
          ("viscosity", "svk+search+viscosity", "svk+search"), ("J2 that stays elastic", "j2", "svk"),
          ("every particle flows", "j2+plastic", "j2"), ("the hardening curve by points", "j2_table+plastic", "j2+plastic"),
          ("every bond looked at, J2", "j2+plastic+search", "j2+plastic"), ("viscosity, J2", "j2+plastic+search+viscosity", "j2+plastic+search")]


def prices(records):
    """What each thing adds to the time of a step on the fewest threads; turn by turn, because the clock drifts."""
    mine = select(records, part="step")
    bodies = list(dict.fromkeys((r["dimension"], r["wanted"]) for r in select(mine, kind="model")))
    if not bodies:
        return ""
    fewest = threads_of(select(mine, kind="step"))[0]

    def times(body, case):
        found = select(mine, kind="step", dimension=body[0], wanted=body[1], case=case, threads=fewest)
        return [r["seconds_per_step"] for r in found]

    rows = []
    for title, dear, cheap in PRICES:
        cells = []
        for body in bodies:
            added = [100 * (a / b - 1) for a, b in zip(times(body, dear), times(body, cheap))]
            cells.append(f"{statistics.median(added):.0f} ({min(added):.0f} to {max(added):.0f})" if added else "")
        if any(cells):
            rows.append([title, *cells])
    cells = [broken_price(mine, body, times(body, "svk+breaking"), times(body, "svk+fracture"), fewest) for body in bodies]
    if any(cells):
        rows.append(["µs per broken bond, instead of %", *cells])
    return grid(f"What it costs, % of the step on {fewest} thread", ["", *(f"{d}D {size_of(n)}" for d, n in bodies)], rows)


def broken_price(records, body, dear, cheap, threads):
    found = select(records, kind="step", dimension=body[0], wanted=body[1], case="svk+breaking", threads=threads)
    broken = [r["broken_per_step"] for r in found]
    costs = [1e6 * (a - b) / n for a, b, n in zip(dear, cheap, broken) if n > 0]
    return f"{short(statistics.median(costs))} ({short(min(costs))} to {short(max(costs))})" if costs else ""


# Hold what another case holds, too.
REPEATED = {"svk+fracture", "svk+breaking", "j2+search", "j2+plastic", "j2_table+plastic"}


def memory(records):
    rows = []
    for m in select(records, part="step", kind="model"):
        if m["case"] in REPEATED:
            continue
        each = [f"{m[key] / m['particles']:.0f}" for key in ("bytes", "resident", "peak")]
        rows.append([f"{m['dimension']}D {size_of(m['wanted'])} {m['case']}", f"{2 * m['bonds'] / m['particles']:.2f}", *each,
                     short(m["set_up_seconds"]), short(1e6 * m["set_up_seconds"] / m["particles"])])
    return grid("Memory and set-up, bytes per particle",
                ["model of", "bonds at a particle", "reported", "resident", "peak of set-up", "set-up, s", "µs per particle"], rows)


def irregular(records):
    mine = select(records, part="irregular")
    threads = threads_of(select(mine, kind="step"))
    rows = []
    for case in values_of(mine, "case"):
        for mesh in values_of(mine, "mesh"):
            these = select(mine, mesh=mesh)
            model = select(these, kind="model", case=case)[0]
            rates = [rate(select(these, kind="step", case=case, threads=n), model["particles"]) for n in threads]
            rows.append([f"{case}, {mesh}", model["particles"], f"{2 * model['bonds'] / model['particles']:.2f}",
                         f"{model['bytes'] / model['particles']:.0f}", *(r.show(1e6) for r in rates)])
    return grid("Numbering and irregular meshes, 3D: millions of particle-steps per second",
                ["mesh", "particles", "bonds at a particle", "B per particle", *head_of(threads, "M/s, ")], rows)


MAPPINGS = {"batch": "Cleave, batches", "point_by_point": "Cleave, one point at a time",
            "textbook<IterativeEigen>": "textbook, Eigen's iterative solver", "textbook<Lapack>": "textbook, LAPACK's dsyev"}


def mapping(records):
    mine = select(records, kind="mapping")
    rows = []
    ours = {}
    for name, title in MAPPINGS.items():
        cells = []
        for plastic in (0, 1):
            m = measured(select(mine, name=f"{name}/plastic:{plastic}"), "seconds")
            if m:
                ours.setdefault(plastic, m.median)
                cells += [m.show(1e-9), short(m.median / ours[plastic])]
        if cells:
            rows.append([title, *cells])
    return grid("J2 return mapping, ns per point, one thread", ["", "elastic", "times ours", "plastic", "times ours"], rows)


def lammps(records):
    mine = select(records, part="lammps")
    if not select(mine, kind="lammps"):
        return ""
    threads = threads_of(select(mine, kind="lammps"))
    rows = []
    for edge in values_of(mine, "edge"):
        these = select(mine, edge=edge)
        best = {}
        for case in values_of(select(these, kind="model"), "case"):
            model = select(these, kind="model", case=case)[0]
            cells = []
            for n in threads:
                ours = rate(select(these, kind="step", case=case, threads=n), model["particles"])
                best[n] = ours.median  # the last, slowest case is compared
                cells += [ours.show(1e6), ""]
            rows.append([f"Cleave {case}", model["particles"], f"{2 * model['bonds'] / model['particles']:.1f}",
                         f"{model['resident'] / model['particles']:.0f}", *cells])
        for style in values_of(these, "style"):
            runs = select(these, style=style)
            cells = []
            for n in threads:
                theirs = rate(select(runs, threads=n), runs[0]["particles"])
                cells += [theirs.show(1e6), f"{best[n] / theirs.median:.1f}"]
            first = select(runs, threads=threads[0])[0]
            rows.append([f"LAMMPS peri/{style}", first["particles"], f"{first['neighbours'] or 0:.1f}",
                         f"{(first['bytes'] or 0) / first['particles']:.0f}", *cells])
    columns = ["", "particles", "neighbours", "B per particle"]
    for n in threads:
        columns += [f"M/s, {n} core{'s' if n > 1 else ''}", "Cleave faster by"]
    return grid("The same block in LAMMPS peridynamics", columns, rows)
