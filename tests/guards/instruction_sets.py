"""Objects compiled for one instruction set share no symbol with the others: instruction_sets.py NM SET OBJECT...

The linker keeps one copy of an inline function, whoever compiled it. One with AVX instructions would then run on
machines without them. So all that such an object defines must be its own (local) or carry the name of its set, as
everything in the renamed namespace does (kernels/src/core/instruction_set.hpp).
"""
import subprocess
import sys

REMEDY = "is shared with other instruction sets; make it part of the namespace cleave, or have it inlined"


def complaints(listing, name):
    """Of the text that `nm` prints: address, letter, symbol. Capital letters are global; u, v, w shared too."""
    found, own = [], f"{len('cleave_' + name)}cleave_{name}"
    for line in listing.splitlines():
        words = line.split()
        if len(words) != 3:  # undefined symbols have no address
            continue
        letter, symbol = words[1:]
        if (letter.isupper() or letter in "uvw") and own not in symbol:
            found.append(f"{symbol}: {REMEDY}")
    return found


def main(arguments):
    nm, name, *objects = arguments
    if not objects:
        print("no objects given")
        return 1
    count = symbols = 0
    for path in objects:
        listing = subprocess.run([nm, path], capture_output=True, text=True, check=True).stdout
        symbols += len(listing.splitlines())
        for complaint in complaints(listing, name):
            print(f"{path}: {complaint}")
            count += 1
    print(f"{name}: {len(objects)} objects, {symbols} symbols, {count} complaints")
    return 1 if count or not symbols else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
