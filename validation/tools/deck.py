"""Variations of a deck: another value for keys that stand in it.

A case keeps one deck that reads well and says what its runs change.  Only the layout used by the
decks of this folder is understood: `&group` and `/` on their own lines, one key a line or several with commas.
"""
import re


class DeckError(Exception):
    """The deck has not the key that is to be changed."""


def written(value):
    """A Python value as namelist text."""
    if isinstance(value, bool):
        return ".true." if value else ".false."
    if isinstance(value, str):
        return "'" + value.replace("'", "''") + "'"
    if isinstance(value, (list, tuple)):
        return ", ".join(written(entry) for entry in value)
    return repr(value)


def _group_span(lines, group, number):
    """Lines first..last of the number-th (from 1) group of that name."""
    seen = 0
    for first, line in enumerate(lines):
        if line.strip().lower().split("!")[0].strip() == "&" + group:
            seen += 1
            if seen == number:
                for last in range(first, len(lines)):
                    if lines[last].strip() == "/":
                        return first, last
    raise DeckError(f"the deck has no group &{group}" + (f" number {number}" if number > 1 else ""))


def _replace(line, key, value):
    """The line with the key's value replaced, or None if the key does not stand in it."""
    pattern = rf"(?i)^((?:[^'!]|'[^']*')*?(?<![\w%]){re.escape(key)}\s*=\s*)(.*?)(\s*(?:,\s*[A-Za-z_]\w*\s*=|!|$))"
    found = re.search(pattern, line)
    if not found:
        return None
    return line[: found.end(1)] + written(value) + line[found.start(3):]


def vary(text, changes):
    """The deck with `group.key` or `group(number).key` set to other values.  Every key must stand in the deck."""
    lines = text.split("\n")
    for name, value in changes.items():
        found = re.fullmatch(r"(\w+)(?:\((\d+)\))?\.(\w+)", name)
        if not found:
            raise DeckError(f"'{name}' is not of the form group.key or group(number).key")
        first, last = _group_span(lines, found[1].lower(), int(found[2] or 1))
        for index in range(first + 1, last):
            changed = _replace(lines[index], found[3], value)
            if changed is not None:
                lines[index] = changed
                break
        else:
            raise DeckError(f"group &{found[1]} of the deck has no key '{found[3]}'")
    return "\n".join(lines)


def without(text, group):
    """The deck without the first group of that name, and without the empty line after it."""
    lines = text.split("\n")
    first, last = _group_span(lines, group.lower(), 1)
    empty = last + 1 < len(lines) and not lines[last + 1].strip()
    return "\n".join(lines[:first] + lines[last + 1 + empty:])
