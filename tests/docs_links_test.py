#!/usr/bin/env python3
"""docs_links_test.py SOURCE_DIR: every link of the Markdown pages leads to a file of the tree and, with #, to a heading of it.

docs/README.md links to every page of docs/.
"""
import pathlib
import re
import sys

LINK = re.compile(r"\]\(([^)\s]+)\)")


def without_code(text):
    return re.sub(r"`[^`\n]*`", "", re.sub(r"^```.*?^```", "", text, flags=re.S | re.M))


def anchors(page):
    """Of headings, as GitHub names them."""
    found = set()
    for heading in re.findall(r"^#+ +(.*)$", re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.S | re.M), flags=re.M):
        words = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
        found.add(re.sub(r"[^\w\- ]", "", words.strip().lower()).replace(" ", "-"))
    return found


def main():
    source = pathlib.Path(sys.argv[1]).resolve()
    pages = [source / "README.md", source / "CONTRIBUTING.md", *sorted((source / "docs").glob("*.md"))]
    failed = count = 0
    leads_to = {}
    for page in pages:
        for link in LINK.findall(without_code(page.read_text(encoding="utf-8"))):
            if re.match(r"[a-z]+:", link):
                continue
            count += 1
            name, _, anchor = link.partition("#")
            target = (page.parent / name).resolve() if name else page
            leads_to.setdefault(page, set()).add(target)
            error = "" if target.exists() else "no such file"
            if not error and anchor and anchor not in anchors(target):
                error = "no such heading"
            if error:
                failed += 1
                print(f"{page.relative_to(source)}: {link}: {error}")
    index = source / "docs/README.md"
    for page in pages[2:]:
        if page != index and page not in leads_to.get(index, ()):
            failed += 1
            print(f"docs/README.md does not link to {page.name}")
    print(f"{count} links, {failed} failed")
    sys.exit(1 if failed or count == 0 else 0)


if __name__ == "__main__":
    main()
