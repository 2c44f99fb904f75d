"""The Fortran module and the Fortran-77 layer offer every function of cleave.h, or the manual says why not; the
table of names in the manual has their arguments; Fortran-77 names have at most six letters."""
import re

from c_interface import HEADER, functions

PAGE = "manuals/reference/fortran.md"
ROW = re.compile(r"(?m)^\| `(cleave_\w+)` \| (.*?) \| (.*?) \|$")


def check(tree):
    module = _text(tree, "kernels/fortran/module/")
    layer = _text(tree, "kernels/fortran/f77/")
    if not module:
        return []
    rows = {name: (ours, plain) for name, ours, plain in ROW.findall(tree.text(PAGE))}
    declared = {name for name, _, _ in functions(tree.text(HEADER))}
    bound = set(re.findall(r"function (cleave_\w+)\([^)]*\) ?bind\(C\)", module))
    complaints = [f"{PAGE}: {name} is no function of cleave.h" for name in sorted(set(rows) - declared)]
    complaints += [f"kernels/fortran/module: {name} is not bound in module cleave_c" for name in sorted(declared - bound)]
    for name in sorted(declared):
        ours, plain = rows.get(name, ("", ""))
        arguments = _module_arguments(module, name)
        if not ours:
            complaints.append(f"{PAGE}: {name} has no line in the table of names")
        elif arguments is None:
            if not re.match(r"not \w+: ", ours):
                complaints.append(f"{PAGE}: {name} is not in module cleave; say why: 'not offered: ...'")
        elif ours != f"`({arguments})`":
            complaints.append(f"{PAGE}: {name} takes ({arguments}) in module cleave, not {ours}")
        if ours and not re.match(r"`CL|not \w+: ", plain):
            complaints.append(f"{PAGE}: name the subroutine for {name}, or say why: 'not offered: ...'")
    return complaints + _plain(layer, rows)


def _plain(layer, rows):
    """Subroutines of the layer against the calls that the table shows."""
    defined = {name.upper(): arguments.upper() for name, arguments
               in re.findall(r"(?m)^recursive subroutine (\w+)\(([^)]*)\)", layer)}
    shown = {name: arguments for _, plain in rows.values()
             for name, arguments in re.findall(r"`(CL\w*)\(([^)]*)\)`", plain)}
    complaints = [f"kernels/fortran/f77: {name} has more than six letters" for name in defined if len(name) > 6]
    for name in sorted(set(defined) | set(shown)):
        if name not in defined:
            complaints.append(f"{PAGE}: {name} is no subroutine of the Fortran-77 layer")
        elif name not in shown:
            complaints.append(f"{PAGE}: {name} is missing in the table of names")
        elif defined[name] != shown[name]:
            complaints.append(f"{PAGE}: {name} takes ({defined[name]})")
    return complaints


def _module_arguments(module, name):
    """Of the first procedure behind a generic name; None if the module does not offer it."""
    generic = re.search(rf"interface {name}\n\s*module procedure (\w+)\n", module)
    return re.search(rf"function {generic.group(1)}\(([^)]*)\)", module).group(1) if generic else None


def _text(tree, folder):
    joined = "\n".join(tree.text(path) for path in tree.paths("*.f90", "*.f90.in", under=folder))
    return re.sub(r"\s*&\n\s*", " ", joined)
