"""Sphinx extension of the manuals: equations as MathML (browsers draw it without a script or the
network), equation tags such as [CBM 8] as links, and pages filled from generated text.

A page that contains the line `<!-- generated: NAME -->` gets the text of NAME.md from the folder
`cleave_generated` in its place. An equation labelled `cbm-8` shows the tag [CBM 8].
"""
import pathlib
import re

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.errors import ExtensionError

MARKER = re.compile(r"<!-- generated: ([\w-]+) -->")
LABEL = re.compile(r"([a-z0-9]+)-([0-9a-z-]+)")
TAG = re.compile(r"\[([A-Z][A-Z0-9]*) ([0-9a-z][0-9a-z, -]*)\]")


def setup(app):
    app.add_config_value("cleave_generated", "", "env")
    app.add_html_math_renderer("mathml", (inline_math, None), (display_math, None))
    app.connect("env-before-read-docs", read_generated_pages_again)
    app.connect("source-read", insert_generated)
    app.connect("doctree-resolved", link_tags)
    return {"parallel_read_safe": True}


def inline_math(translator, node):
    translator.body.append(mathml(node.astext(), True))
    raise nodes.SkipNode


def display_math(translator, node):
    label = node.get("label")
    anchor = f' id="{anchor_of(label)}"' if label else ""
    tag = f'<span class="tag">[{tag_of(label)}]</span>' if label else ""
    translator.body.append(f'<div class="equation"{anchor}><div>{mathml(node.astext(), False)}</div>{tag}</div>\n')
    raise nodes.SkipNode


def mathml(text, inline):
    try:
        # browsers no longer read mathvariant="bold"; the style sheet does it by class
        return tex2mathml(text, inline=inline).replace('mathvariant="bold"', 'class="mathbf"')
    except SyntaxError as error:
        raise ExtensionError(f"equation not understood: {text!r}: {error}") from error


def tag_of(label):
    method, number = LABEL.fullmatch(label).groups()
    return f"{method.upper()} {number}"


def anchor_of(label):
    return "tag-" + label


def insert_generated(app, docname, source):
    def text(match):
        path = pathlib.Path(app.config.cleave_generated, match.group(1) + ".md")
        if not app.config.cleave_generated or not path.is_file():
            raise ExtensionError(f"{docname}: {path} is missing; build the CMake target `manuals`")
        return path.read_text(encoding="utf-8")
    source[0] = MARKER.sub(text, source[0])


def read_generated_pages_again(app, env, docnames):
    """What is generated may have changed although the page that shows it has not."""
    pages = [name for name in env.found_docs if MARKER.search(pathlib.Path(env.doc2path(name)).read_text(encoding="utf-8"))]
    docnames += [name for name in pages if name not in docnames]


def link_tags(app, doctree, docname):
    """[CBM 8] in running text becomes a link to its equation; in code it stays as it is."""
    equations = app.env.get_domain("math").equations
    for text in list(doctree.findall(nodes.Text)):
        if isinstance(text.parent, (nodes.literal, nodes.literal_block, nodes.math, nodes.reference, nodes.math_block)):
            continue
        pieces = [piece for match in split(TAG, text.astext()) for piece in link(app, docname, equations, match)]
        if any(isinstance(piece, nodes.reference) for piece in pieces):
            text.parent.replace(text, pieces)


def split(pattern, text):
    """Text and matches in turn."""
    end = 0
    for match in pattern.finditer(text):
        yield text[end:match.start()]
        yield match
        end = match.end()
    yield text[end:]


def link(app, docname, equations, piece):
    if isinstance(piece, str):
        return [nodes.Text(piece)] if piece else []
    wanted = piece.group(2).split(",")[0].strip().split("-")[0]
    for label, (target, _) in equations.items():
        method, number = LABEL.fullmatch(label).groups()
        ends = re.fullmatch(r"(\d+)-(\d+)", number)
        inside = ends and wanted.isdigit() and int(ends.group(1)) <= int(wanted) <= int(ends.group(2))
        if method == piece.group(1).lower() and (number in (wanted, piece.group(2)) or inside):
            uri = app.builder.get_relative_uri(docname, target) + "#" + anchor_of(label)
            return [nodes.reference("", piece.group(0), refuri=uri, internal=True)]
    return [nodes.Text(piece.group(0))]
