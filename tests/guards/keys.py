"""Every group and key of the key table, and every parameter of the kernels, is used in a deck of the
repository that is meant to be read; every group and key of those decks exists."""
import re

from tree import calls

TABLE = "driver/src/deck/keys.def"
GROUPS_OF_KERNELS = "kernels/src/tables/groups.def"
# Keys without a deck, with the reason.
NOT_IN_A_DECK = {}


def check(tree):
    table = tree.text(TABLE)
    groups = {arguments[0] for arguments in calls(table, "CLEAVE_GROUP")}
    keys = {(arguments[0], arguments[1].lower()) for arguments in calls(table, "CLEAVE_KEY")}
    kernel_groups = {arguments[0] for arguments in calls(tree.text(GROUPS_OF_KERNELS), "CLEAVE_GROUP")}
    keys |= {(group, arguments[0]) for group in kernel_groups for arguments in calls(table, "CLEAVE_PARAMETER_KEY")}
    parameters = _parameters(tree)
    with_parameters = kernel_groups | {"material"}

    used, complaints = set(), []
    for path in tree.paths("*.nml"):
        if "bad_decks/" in path or path.startswith("tests/io/"):
            continue
        for line, group, key in _assignments(tree.text(path)):
            used.add((group, key))
            if group not in groups | kernel_groups:
                complaints.append(f"{path}:{line}: there is no group {group}")
            elif (group, key) not in keys and not (group in with_parameters and key in parameters):
                complaints.append(f"{path}:{line}: there is no key {group}.{key}")
    shown_parameters = {key for group, key in used if group in with_parameters}
    for name in sorted(set(parameters) - shown_parameters):
        complaints.append(f"{parameters[name]}: parameter {name} is in no deck of the repository; show it in one")
    for group, key in sorted(keys - used - set(NOT_IN_A_DECK)):
        if group not in kernel_groups or all((other, key) not in used for other in kernel_groups):
            complaints.append(f"{TABLE}: {group}.{key} is in no deck of the repository; show it in one")
    for group, key in sorted(used & set(NOT_IN_A_DECK)):
        complaints.append(f"tests/guards/keys.py: {group}.{key} is in a deck now; take it off the list")
    return complaints


def _parameters(tree):
    """Names of all material properties and formulation parameters, lower case, and where they are declared."""
    declared = {}
    for path in tree.paths("kernels/src/material/*.hpp", "kernels/src/formulation/*.hpp"):
        text = tree.text(path)
        for match in re.finditer(r'\b\w+_parameter\(\s*"(\w+)"', text):
            declared[match.group(1).lower()] = f"{path}:{text.count(chr(10), 0, match.start()) + 1}"
    return declared


def _assignments(text):
    """(line, group, key) of a deck written plainly: one or more `key = value` a line."""
    text = re.sub(r"'(?:[^'\n]|'')*'|\"[^\"\n]*\"", "''", text)
    text = re.sub(r"![^\n]*", "", text)
    group = None
    for number, line in enumerate(text.splitlines(), start=1):
        for match in re.finditer(r"[&$](\w+)|(?<![\w.])([a-zA-Z]\w*)\s*(?:\([^)]*\))?\s*=|(?<=\s)/|^/", line):
            if match.group(1):
                group = None if match.group(1).lower() == "end" else match.group(1).lower()
            elif match.group(2):
                if group:
                    yield number, group, match.group(2).lower()
            else:
                group = None
