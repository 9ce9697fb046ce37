#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fails where a link leads nowhere: check_links.py FOLDER.

Looks at every Markdown and HTML file below FOLDER, build folders left out: links to files and
to headings within the project. Links to other sites are not followed."""
import html.parser
import os
import re
import sys
import urllib.parse

root = os.path.abspath(sys.argv[1])


class Page(html.parser.HTMLParser):
    """Links and marks of a page."""

    def __init__(self, text):
        super().__init__()
        self.links, self.marks = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for key, value in attributes:
            if key in ("href", "src") and value:
                self.links.append(value)
            elif key == "id" or (key == "name" and tag == "a"):
                self.marks.add(value)


def markdown(text):
    """(links, marks) as GitHub makes them of headings."""
    text = re.sub(r"^(```|~~~).*?^\1", "", text, flags=re.S | re.M)
    marks = set()
    for heading in re.findall(r"^#+ +(.*?) *#*$", text, re.M):
        plain = re.sub(r"[^\w\- ]", "", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower())
        marks.add(plain.replace(" ", "-"))
    text = re.sub(r"`[^`\n]*`", "", text)
    return re.findall(r"\]\(<?([^)>\s]+)>?(?: \"[^\"]*\")?\)", text), marks


def contents(path, known={}):
    """(links, marks) of a file, read once."""
    if path not in known:
        with open(path, encoding="utf-8", errors="replace") as file:
            text = file.read()
        if path.endswith(".md"):
            known[path] = markdown(text)
        else:
            page = Page(text)
            known[path] = page.links, page.marks
    return known[path]


def wrong(path, link):
    """What is wrong with a link, or nothing."""
    target, _, mark = link.partition("#")
    if re.match(r"^[a-z][a-z0-9+.-]*:", link) or link.startswith("//"):
        return None
    target = urllib.parse.unquote(target.partition("?")[0])
    file = os.path.normpath(os.path.join(os.path.dirname(path), target)) if target else path
    if not os.path.exists(file):
        return "there is no such file"
    if os.path.commonpath([root, file]) != root:
        return "it leads out of the folder"
    if mark and file.endswith((".md", ".html")) and \
            urllib.parse.unquote(mark) not in contents(file)[1]:
        return "there is no such heading"
    return None


failed = looked = 0
for folder, folders, names in os.walk(root):
    folders[:] = [f for f in folders if not f.startswith(("build", ".", "demo"))]
    for name in sorted(names):
        path = os.path.join(folder, name)
        if not name.endswith((".md", ".html")) or os.path.relpath(path, root) == \
                "src/export/view.html":
            continue
        for link in contents(path)[0]:
            looked += 1
            why = wrong(path, link)
            if why:
                failed += 1
                print("%s: %s: %s" % (os.path.relpath(path, root), link, why))
print("%d links, %d lead nowhere" % (looked, failed))
sys.exit(failed > 0 or looked == 0)
