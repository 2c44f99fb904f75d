"""Random namelist files for the variables of oracle.f90: every spelling that Fortran knows, in any mixture."""
import random

# name: (type, extents or None, lower bound of each dimension)
VARIABLES = {
    "i": ("integer", None), "j": ("integer", None), "i8": ("integer", None),
    "iv": ("integer", [(1, 6)]), "m": ("integer", [(1, 2), (1, 3)]), "neg": ("integer", [(-2, 5)]),
    "r": ("real", None), "rv": ("real", [(1, 6)]), "rm": ("real", [(1, 2), (1, 2), (1, 2)]),
    "l": ("logical", None), "t": ("logical", None), "f": ("logical", None), "lv": ("logical", [(1, 4)]),
    "s": ("text", None), "sv": ("text", [(1, 3)]),
    "z": ("complex", None), "zv": ("complex", [(1, 3)]),
    "d%a": ("integer", None), "d%b": ("real", [(1, 2)]), "d%nm": ("text", None),
    "d%c%n": ("integer", 3), "d%c(2)%w": ("real", None), "d%c(2:3)%n": ("integer", 2),
    "d%c(1:3:2)%w": ("real", 2), "dv%a": ("integer", 2), "dv(2)%b": ("real", [(1, 2)]),
    "dv(1)%nm": ("text", None), "dv(2)%c%w": ("real", 3), "dv(2:1:-1)%a": ("integer", 2),
    "dv(1)%c(3)%n": ("integer", None), "dv%c(2)%n": ("integer", 2),
}  # an integer in place of extents: that many values and no subscripts to add


class Writer:
    def __init__(self, seed):
        self.random = random.Random(seed)

    def chance(self, probability):
        return self.random.random() < probability

    def pick(self, *choices):
        return self.random.choice(choices)

    def digits(self, longest):
        return "".join(self.random.choices("0123456789", k=self.random.randint(1, longest)))

    def cased(self, word):
        style = self.random.randrange(6)
        if style == 0:
            return word.upper()
        if style == 1:
            return "".join(self.random.choice((c, c.upper())) for c in word)
        return word

    # ---- values

    def integer(self):
        return self.pick("", "", "-", "+") + self.pick("0", "7", "007", self.digits(3), self.digits(9))

    def real(self):
        if self.chance(0.1):
            return self.cased(self.pick("inf", "-inf", "+inf", "infinity", "-infinity", "nan", "nan(1)", "+nan"))
        whole, part = self.digits(self.pick(1, 3, 19)), self.digits(self.pick(1, 3, 22))
        mantissa = self.pick(whole, whole + ".", "." + part, whole + "." + part)
        sign = self.pick("", "", "-", "+")
        power = str(self.random.randrange(0, self.pick(4, 40, 330)))
        exponent = self.pick(
            "", "",
            self.pick("e", "E", "d", "D", "q", "Q") + self.pick("", "-", "+") + self.pick("", "0") + power,
            self.pick("-", "+") + power)
        return sign + mantissa + exponent

    def logical(self):
        return self.cased(self.pick("t", "f", ".t.", ".f.", ".true.", ".false.", ".t", ".f", ".true", ".false",
                                    "true", "false", "tr", "Falsch"))

    def text(self):
        quote = self.pick("'", '"')
        body = ""
        for _ in range(self.random.randrange(0, 14)):
            body += self.pick("a", "Z", "5", " ", "\t", "/", "&", "$", "!", ",", "=", "(", "%", quote * 2,
                              "'" if quote == '"' else '"', "\u00e9", "*", "end", "\\n")
        if self.chance(0.1):
            body += "\n" + self.pick("", " ") + "more"
        return quote + body + quote

    def complex(self):
        blank = lambda: self.pick("", "", "", " ", "\t", "\n")
        part = lambda: self.integer() if self.chance(0.3) else self.real()
        return f"({blank()}{part()}{blank()},{blank()}{part()}{blank()})"

    def value(self, kind):
        if kind == "real" and self.chance(0.2):
            return self.integer()
        return getattr(self, kind)()

    # ---- lists

    def comment(self):
        return "!" + self.pick("", " note", " don't", ' "', " a = 1, /", " &end", "!") + "\n"

    def separator(self, kind):
        blanks = self.pick("", " ", "  ", "\t")
        plain = [" ", ",", ", ", " ,", ";", "\n", ",\n", "\n  ", ",\n\n ", blanks + "," + blanks, "\r\n"]
        odd = [" !c\n", "!c\n,", "\n,", ",\n,", ",\n!c\n", "\n\n!c\n ", ",\n ,", " " + self.comment(), ";\n", "\n;"]
        if kind != "text":  # gfortran gives up at a comment between a comma and a text
            odd += [", !c\n", ",!c\n,", ",!c\n!c\n\n"]
        return self.random.choice(plain if self.chance(0.85) else odd)

    def values(self, kind, room):
        """Values for at most `room` elements with everything between them."""
        result = self.pick("", "", " ", "  ", "\t", "\n", "\n  ")
        left = self.random.randint(1, room)
        while left > 0:
            count = 1
            if self.chance(0.12):  # empty values
                if self.chance(0.5):
                    count = self.random.randint(1, left)
                    # gfortran takes a comment directly after the '*' for a text
                    result += f"{count}*" + (" " if kind == "text" else "")
                else:
                    result += ","
            elif left > 1 and self.chance(0.25):
                count = self.random.randint(1, left)
                result += f"{count}*{self.value(kind)}"
            else:
                result += self.value(kind)
            left -= count
            if left > 0:
                between = self.separator(kind)
                left -= between.count(",") + between.count(";") + between.count("!")  # may be empty values
                result += between
        return result

    # ---- names

    def section(self, extents):
        """Subscripts and the number of elements they name."""
        if all(self.chance(0.4) for _ in extents):
            texts, room = [], 1
            for lower, count in extents:  # from an element on
                first = self.random.randrange(count)
                texts.append(self.pick("", "", "+" if lower + first >= 0 else "") + str(lower + first))
                room *= count - first
            return texts, room
        texts, room, ranges = [], 1, 0
        for lower, count in extents:
            upper = lower + count - 1
            first = self.random.randint(lower, upper)
            last = self.random.randint(first, upper)
            form = self.random.randrange(7)
            if form == 0 and len(extents) > 1:
                texts.append(str(first))
                continue
            ranges += 1
            if form <= 1:
                texts.append(":")
                room *= count
            elif form == 2:
                texts.append(f"{first}:")
                room *= upper - first + 1
            elif form == 3:
                texts.append(f":{last}")
                room *= last - lower + 1
            elif form == 4:
                stride = self.random.randint(1, 3)
                texts.append(f"{first}:{last}:{stride}")
                room *= (last - first) // stride + 1
            elif form == 5:
                stride = self.random.randint(1, 3)
                texts.append(f"{last}:{first}:-{stride}")
                room *= (last - first) // stride + 1
            else:
                texts.append(f"{first}:{last}")
                room *= last - first + 1
        return (texts, room) if ranges else self.section(extents)

    def assignment(self):
        name = self.random.choice(list(VARIABLES))
        kind, extents = VARIABLES[name]
        room = extents if isinstance(extents, int) else 1
        written = name
        if isinstance(extents, list):
            for _, count in extents:
                room *= count
            if self.chance(0.5):
                texts, room = self.section(extents)
                written += "(" + self.pick(",", ", ").join(texts) + ")"
        if kind == "text" and self.chance(0.15) and room == 1:
            written += self.pick("(2:5)", "(:3)", "(4:)", "(:)") if extents is None else ""
        equals = self.pick("=", " = ", "= ", " =", "\n=\n", "\t=\t")
        return self.cased(written) + equals + self.values(kind, room)

    # ---- files

    def between_assignments(self):
        return self.pick("\n", "\n", "\n", "\n  ", ",\n", ", ", " ", ";\n", " ! c, 1\n",
                         ", ! c\n", "\n! x = 3\n\n", ",,\n")

    def group(self):
        mark = self.pick("&", "&", "&", "$")
        text = mark + self.cased("g") + self.pick("\n", " ", "  \n", "\t", ", ", " ! comment\n", "!c\n")
        after_logical = False
        for _ in range(self.random.randrange(0, 6)):
            assignment = self.assignment()
            # gfortran may take a name for another logical; here it is always a name.
            if after_logical and assignment[0] in "tTfF":
                continue
            after_logical = assignment[0] in "lLtTfF"
            text += assignment + self.between_assignments()
        return text + self.pick("/", "/", "/", mark + "end", "&END", "$end") + self.pick("", " ", " text") + "\n"

    def other_group(self):
        values = " , ".join(self.real() for _ in range(self.random.randint(1, 3)))
        return f"&h n = {self.integer()} x = {values} /\n"

    def between_groups(self):
        return self.pick("", "", "\n", "! comment &g i = 3 /\n", "some text, don't = read (it\n", "a & b $ 5\n\n", "  ")

    def file(self):
        text = ""
        count = self.random.randint(1, 3)
        for _ in range(count):
            text += self.between_groups() + (self.other_group() if self.chance(0.25) else self.group())
        text += self.between_groups() + "\n"
        if self.chance(0.15):
            text = text.replace("\r\n", "\n").replace("\n", "\r\n")
        return text.encode("utf-8"), count


def random_file(seed):
    """The bytes of a file and the number of groups in it."""
    return Writer(seed).file()
