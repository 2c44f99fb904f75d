"""Markdown page of the C interface, from the comments and declarations of cleave.h. Nothing is
written here that does not stand in the header."""
import re


def page(header):
    """The page: introduction, then every section of the header with its declarations."""
    parts = []
    for kind, text in pieces(header):
        if kind == "section":
            parts.append(f"## {text}")
        elif kind == "comment":
            parts.append(prose(text))
        else:
            parts.append(declaration(text))
    return "\n\n".join(part for part in parts if part) + "\n"


def pieces(header):
    """("section" | "comment" | "code", text) in order; what is only for the preprocessor is left out."""
    body = header[header.index("*/") + 2:]
    yield "comment", comment_text(header[:header.index("*/") + 2])
    body = re.sub(r"(?m)^#(if|ifdef|ifndef|else|endif|include|pragma|undef).*\n", keep_tables, body)
    body = re.sub(r'(?m)^(extern "C" \{|\})\s*$', "", body)
    body = re.sub(r"(?m)^#define (CLEAVE_H|CLEAVE_API\b|CLEAVE_(STATUS|MATERIAL|FORMULATION)\().*\n", "", body)
    for block in re.split(r"\n\s*\n", body.strip()):
        yield from split_block(block.strip())


def keep_tables(match):
    """The enumerations made from a table say so."""
    table = re.search(r'#include "(cleave/tables/\w+\.def)"', match.group(0))
    return f"  /* one value for each line of {table.group(1)} */\n" if table else ""


def split_block(block):
    while block:
        section = re.match(r"/\*\s*-{4,}\s*(.*?)\s*-{4,}\s*\*/\s*", block)
        comment = re.match(r"/\*.*?\*/\s*", block, flags=re.S)
        if section:
            yield "section", section.group(1).capitalize()
            block = block[section.end():]
        elif comment:
            text = comment_text(comment.group(0))
            loop = re.match(r"-{2,}\s*([\w\s]+)[:,.]\s*(.*)", text, flags=re.S)
            yield "comment", f"{loop.group(1).strip().capitalize()}: {loop.group(2)}" if loop else text
            block = block[comment.end():]
        else:
            end = re.search(r"(?m)^/\*", block)
            yield "code", block[:end.start()].strip() if end else block
            block = block[end.start():].strip() if end else ""


def comment_text(comment):
    text = re.sub(r"^/\*|\*/$", "", comment.strip())
    return re.sub(r"(?m)^ ?\* ?", "", text).strip()


def prose(text):
    """Aligned text (argument lists, algorithms) keeps its lines; a sentence becomes a paragraph."""
    lines = text.splitlines()
    if len(lines) == 1 or not any(re.search(r"^\s*(\[|- )|\S\s{2,}\S", line) for line in lines):
        return " ".join(line.strip() for line in lines)
    return "```text\n" + text + "\n```"


def declaration(text):
    names = re.findall(r"(?m)^CLEAVE_API.*?\b(cleave_\w+)\s*\(", text)
    heading = "".join(f"({name})=\n" for name in names)
    return heading + "```c\n" + text + "\n```" if text else ""
