"""Which folder may include what: driver -> cleave.h and io; kernels and io never meet."""
import posixpath

from tree import SOURCE

# Folder: where its quoted includes may be found, and libraries it must not see.
HOUSE = {
    "kernels/": (("kernels/src/", "kernels/include/"),
                 ("netcdf", "exodusII", "CLI/", "nlohmann/", "boost/")),
    "io/": (("io/", ""), ("Eigen/", "CLI/", "boost/", "cleave/")),
    "driver/": (("driver/src/", ""), ("netcdf", "exodusII", "Eigen/", "boost/")),
}
PUBLIC = ("cleave/cleave.h", "cleave/version.h")  # version.h is made from version.h.in
MADE = {"kernels/adapters/calculix/": ("laws.def",)}  # by CMake, from the materials table


def check(tree):
    complaints = []
    for path, line, match in tree.find(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', tree.paths(*SOURCE)):
        folder = next((name for name in HOUSE if path.startswith(name)), None)
        if folder:
            reason = _objection(tree, folder, path, match.group(1), match.group(2))
            if reason:
                complaints.append(f"{path}:{line}: {folder[:-1]} includes {match.group(2)}: {reason}")
    return complaints


def _objection(tree, folder, path, bracket, name):
    roots, strangers = HOUSE[folder]
    if name.startswith(strangers):
        return "this library is not used in this folder; see manuals/developer/house.md"
    if folder != "io/" and (name in PUBLIC or name.startswith("cleave/tables/")):
        return None
    if name in MADE.get(posixpath.dirname(path) + "/", ()):
        return None
    if bracket == "<":
        return None
    places = [posixpath.normpath(posixpath.join(root, name)) for root in (posixpath.dirname(path), *roots)]
    found = next((place for place in places if tree.has(place)), None)
    if found is None:
        return "not a file this folder may include (kernels are reached through cleave/cleave.h only)"
    allowed = (folder, "io/") if folder == "driver/" else (folder,)
    if not found.startswith(allowed):
        return f"it is {found}, in a folder this one must not know"
    return None
