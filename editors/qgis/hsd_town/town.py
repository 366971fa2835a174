# SPDX-License-Identifier: GPL-2.0-or-later
"""The text of a town, from layers, fields and rules. Nothing here needs QGIS."""

from xml.sax.saxutils import quoteattr

RULES = ["", "so-nikai", "40.5", "", "chu-nikai", "19.3", "", "kanban", "20.4", "", "hiraya", "9.3"]


def rows(flat, width):
    """The rows of a table as Processing hands it over, one value after another; rows without any are left out."""
    cells = ["" if c is None else str(c).strip() for c in flat or []]
    found = [cells[i:i + width] for i in range(0, len(cells), width)]
    return [row + [""] * (width - len(row)) for row in found if any(row)]


def field_lines(fields):
    return [f"    <Field name={quoteattr(name or source)} from={quoteattr(source)}/>" for source, name in fields if source]


def layer(name, file, key="", fields=(), local=False):
    """A layer of the town, with the fields that rules name differently than the map."""
    head = f"  <Layer name={quoteattr(name)} src={quoteattr(file)}"
    head += f" key={quoteattr(key)}" if key else ""
    head += ' crs="local"' if local else ""
    inner = field_lines(fields)
    return [head + ">", *inner, "  </Layer>"] if inner else [head + "/>"]


def choices(rules, indent):
    """Types that are drawn by their shares, or the only one."""
    if len(rules) == 1:
        return [f"{indent}<Place type={quoteattr(rules[0][1])}/>"]
    lines = [f'{indent}  <choice weight={quoteattr(share or "1")}><Place type={quoteattr(kind)}/></choice>' for _, kind, share in rules]
    return [f"{indent}<random>", *lines, f"{indent}</random>"]


def groups(rules):
    """Rules by their test, in the order in which tests come first; those without a test last."""
    tests = dict.fromkeys(test for test, _, _ in rules if test)
    found = [(test, [r for r in rules if r[0] == test]) for test in tests]
    rest = [r for r in rules if not r[0]]
    return found, rest


def branches(found, rest, indent="    "):
    """Tests one in the other: the first that holds decides."""
    if not found:
        return choices(rest, indent) if rest else [f'{indent}<Skip because="no rule takes it"/>']
    (test, rules), others = found[0], found[1:]
    return [
        f"{indent}<if test={quoteattr('{' + test + '}')}>", *choices(rules, indent + "  "), f"{indent}</if>",
        f"{indent}<else>", *branches(others, rest, indent + "  "), f"{indent}</else>",
    ]


def text(name, seed, layers, rules, types=(), smallest=9.0):
    """A town: `layers` are lines from `layer`, `rules` rows of test, type and share. `types` are the values of a field `hsd_type`,
    which go before the rules."""
    found, rest = groups(rules)
    named = [(f"hsd_type = '{kind}'", [["", kind, ""]]) for kind in types]
    return "\n".join([
        "<!-- Written by QGIS: change it as you like, and build it with the algorithm for town files. -->",
        f'<Town name={quoteattr(name)} seed="{seed}">',
        *layers,
        "",
        f'  <for each="houses" test="{{area &lt; {smallest:g}}}"><Skip because="a shed"/></for>',
        f'  <for each="houses" test="{{area &gt;= {smallest:g}}}">',
        *branches(named + found, rest),
        "  </for>",
        "</Town>",
        "",
    ])
