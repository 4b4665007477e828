"""Pages of the C++ and the Python interface, for scripts/site: from the public headers, and from the module's stub."""
import ast
import re
import textwrap

TYPE = re.compile(r"^(?:template <.*> *)?(?:struct|class|enum class|enum|using) (?:\[\[\w+\]\] )?(\w+)\b(?! *;)")
FUNCTION = re.compile(r"(?:^|[ *&])(operator\S+|\w+)\(")
CONSTANT = re.compile(r"^(?:inline )?constexpr .*?(\w+)(?:\{| = )")


def plain(text):
    """A comment as Markdown: what is between backquotes stays, nothing else has a meaning there."""
    parts = text.split("`")
    for i in range(0, len(parts), 2):
        parts[i] = re.sub(r"([\\*_<>\[\]#])", r"\\\1", parts[i])
    return "`".join(parts)


def items_of_header(text):
    """Declarations of the namespace, each a list of lines: they lie between empty lines outside braces."""
    begin = text.index("namespace pinocchio {") + len("namespace pinocchio {")
    body = text[begin:text.rindex("}")]
    item, depth = [], 0
    for line in body.splitlines():
        if line.strip() or depth > 0:
            item.append(line)
        elif item:
            yield item
            item = []
        code = re.sub(r'//.*|"[^"]*"', "", line)
        depth += code.count("{") - code.count("}") + code.count("(") - code.count(")")
    if item:
        yield item


def split_comment(lines):
    """The comment above a declaration, and the rest."""
    n = next((i for i, line in enumerate(lines) if not line.startswith("//")), len(lines))
    return " ".join(line[2:].strip() for line in lines[:n]), lines[n:]


def names_of(code):
    """What a declaration's lines at the margin declare."""
    names = []
    for line in code:
        if not line or line[0] in " }/" or line.startswith(("template", "#")):
            continue
        line = re.sub(r"\[\[\w+\]\] |//.*", "", line)
        found = TYPE.match(line) or CONSTANT.match(line) or FUNCTION.search(line)
        if found and found[1] not in names:
            names.append(found[1])
    return names


def header_page(header):
    """Markdown of a public header, and the names that it declares."""
    text = header.read_text(encoding="utf-8")
    page, declared = [f"# pinocchio/{header.name}", f"`#include <pinocchio/{header.name}>`"], []
    for item in items_of_header(text):
        comment, code = split_comment(item)
        names = names_of(code)
        if not code or (not names and all(re.match(r"(struct|class) \w+;|namespace |}|$", line) for line in code)):
            continue
        declared += names
        if names:
            page.append("## " + ", ".join(name.replace("_", r"\_") for name in names))
        if comment:
            page.append(plain(comment))
        page.append("```cpp\n" + "\n".join(code) + "\n```")
    return "\n\n".join(page) + "\n", declared


def cpp_pages(headers):
    """{page: Markdown} of the public headers, their index first."""
    pages, rows = {}, []
    for header in sorted(headers, key=lambda h: h.name):
        page, names = header_page(header)
        pages[f"api/{header.stem}.md"] = page
        rows.append(f"| [{header.name}]({header.stem}.md) | " + ", ".join(f"`{name}`" for name in names) + " |")
    index = "# C++ interface\n\nThe public headers, namespace `pinocchio`. [As a library](../library.md) begins with an example.\n\n"
    return {"api/index.md": index + "| header | declares |\n|---|---|\n" + "\n".join(rows) + "\n", **pages}


def shown(text):
    """A docstring: paragraphs, of which indented ones are code."""
    result = []
    for paragraph in re.split(r"\n\s*\n", textwrap.dedent(text).strip()):
        lines = paragraph.splitlines()
        is_code = lines[0].startswith("    ")
        is_list = any(re.match(r"\s*[-*] |\S+: |\w+  ", line) for line in lines[1:])
        result.append("```\n" + textwrap.dedent(paragraph) + "\n```" if is_code or is_list else plain(paragraph))
    return "\n\n".join(result)


def docstring(node):
    text = ast.get_docstring(node, clean=True) or ""
    return shown(text) if text else ""


def signature(node):
    arguments = ast.unparse(node.args)
    returns = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    text = f"{node.name}({arguments}){returns}"
    if len(text) > 100:  # an argument a line
        inside = ast.unparse(node.args)
        parts, depth, part = [], 0, ""
        for character in inside:
            depth += character in "[({"
            depth -= character in "])}"
            if character == "," and depth == 0:
                parts.append(part.strip())
                part = ""
            else:
                part += character
        parts.append(part.strip())
        text = f"{node.name}(\n    " + ",\n    ".join(parts) + f"){returns}"
    return text.replace("pinocchio_renderer._core.", "")


def is_property(node):
    return any(isinstance(d, ast.Name) and d.id == "property" for d in node.decorator_list)


def function_text(node, level):
    heading = f"{'#' * level} {node.name.replace('_', chr(92) + '_')}\n\n"
    return heading + f"```python\n{signature(node)}\n```\n\n" + docstring(node) + "\n"


def class_text(node):
    """Its description, its attributes as a table, its methods."""
    page = [f"## {node.name}", docstring(node)]
    rows = []
    methods = []
    for member in node.body:
        if not isinstance(member, ast.FunctionDef):
            continue
        if is_property(member):
            kind = ast.unparse(member.returns).replace("pinocchio_renderer._core.", "").replace("|", r"\|") if member.returns else ""
            about = " ".join((ast.get_docstring(member) or "").split())
            rows.append(f"| `{member.name}` | {plain(about)} | `{kind}` |")
        elif member.name == "__init__" or not member.name.startswith("_"):
            methods.append(member)
    if rows:
        page.append("| attribute | what it is | type |\n|---|---|---|\n" + "\n".join(rows))
    page += [function_text(method, 3) for method in methods]
    return "\n\n".join(part for part in page if part) + "\n"


def python_page(stub, sources):
    """Of the stub of the compiled part, and of the functions that are written in Python: the public names of `sources[0]`."""
    package = ast.parse(sources[0])
    exported = next(ast.literal_eval(n.value) for n in package.body if isinstance(n, ast.Assign) and n.targets[0].id == "__all__")
    nodes = {}
    for text in [stub, *sources[1:]]:
        for node in ast.parse(text).body:
            if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
                nodes.setdefault(node.name, node)
    page = ["# Python interface", shown(ast.get_docstring(package)), "[Python](python.md) begins with examples."]
    for name in exported:
        node = nodes.get(name)
        if isinstance(node, ast.ClassDef):
            page.append(class_text(node))
        elif node:
            page.append(function_text(node, 2))
    return "\n\n".join(page) + "\n"
