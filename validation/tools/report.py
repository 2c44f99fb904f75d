"""The HTML page of a validation run: a table and the pictures of every case.  Plain HTML, no scripts."""
import html

STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; max-width: 1100px; margin: 2em auto; padding: 0 1em; color: #1d2733; }
h1, h2 { font-weight: 600; } h2 { margin-top: 2.2em; border-bottom: 1px solid #d5dbe1; padding-bottom: .2em; }
table { border-collapse: collapse; width: 100%; }
th, td { text-align: right; padding: .22em .7em; border-bottom: 1px solid #e8ecf0; }
th { background: #f3f5f7; }
td:first-child, th:first-child { text-align: left; }
td.source { text-align: left; color: #5b6876; font-size: 13px; }
.PASS { color: #1a7f37; } .FAIL { color: #fff; background: #c62828; } .MISS { color: #9a6700; } .INFO { color: #5b6876; }
figure { margin: 1.4em 0; } img { max-width: 100%; } figcaption { color: #5b6876; }
"""


def _table(case):
    rows = ["<table><tr><th>quantity<th>value<th>reference<th>allowed<th>verdict<th>where reference and band come from</tr>"]
    for figure in case.ledger.figures:
        _, quantity, value, reference, allowed, verdict = (html.escape(text) for text in figure.columns())
        rows.append(f"<tr><td>{quantity}<td>{value}<td>{reference}<td>{allowed}<td class={verdict}>{verdict}"
                    f"<td class=source>{html.escape(figure.reference.source)}</tr>")
    return "\n".join([*rows, "</table>"])


def _case(case):
    parts = [f"<h2>{html.escape(case.name)}</h2>", f"<p>{html.escape(case.title())}</p>", _table(case)]
    parts += [f"<p>note: {html.escape(note)}</p>" for note in case.notes]
    parts += [f'<figure><img src="{html.escape(str(name))}" alt=""><figcaption>{html.escape(caption)}</figcaption></figure>'
              for name, caption in case.pictures]
    return "\n".join(parts)


def write(folder, cases, mode):
    """Writes index.html into the folder and returns its path."""
    folder.mkdir(parents=True, exist_ok=True)
    page = folder / "index.html"
    body = "\n".join(_case(case) for case in cases)
    head = f'<meta charset="utf-8"><title>Validation</title><style>{STYLE}</style>'
    page.write_text(f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head>'
                    f"<body><h1>Validation, --{mode}</h1>\n{body}\n</body></html>\n", encoding="utf-8")
    return page
