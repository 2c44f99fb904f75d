"""The named constants of cleave.f90 are the enumerators of cleave.h, all of them, with their values: read
from the preprocessed header, not by the rule that makes the module.

    constants.py CLEAVE_F90 C_COMPILER INCLUDE..."""
import re
import subprocess
import sys

module, compiler, *includes = sys.argv[1:]
header = subprocess.run([compiler, "-E", "-P", *(f"-I{i}" for i in includes), "-xc", "-"], check=True,
                        input='#include "cleave/cleave.h"\nint abi = CLEAVE_ABI_VERSION;\n',
                        capture_output=True, text=True).stdout
wanted = {"CLEAVE_ABI_VERSION": re.search(r"int abi = (\d+);", header).group(1)}
for body in re.findall(r"enum \w+ \{(.*?)\}", header, flags=re.S):
    wanted.update(re.findall(r"(CLEAVE_\w+) = (\d+)", body))
wanted = {name: value for name, value in wanted.items() if not name.endswith("_END_")}
found = dict(re.findall(r"parameter, public :: (CLEAVE_\w+) = (\d+)", open(module, encoding="utf-8").read()))
for name in sorted(set(wanted) | set(found)):
    if wanted.get(name) != found.get(name):
        print(f"{name}: {wanted.get(name)} in cleave.h, {found.get(name)} in {module}")
sys.exit(wanted != found or len(wanted) < 60)
