"""The pages of the site: pages.py OUT [--reference PAGE] [--manual FILE]...; called by scripts/site.sh.

Every Markdown file of the tree becomes a page at its own place (README.md becomes index.html), and what pages point to lies where
they look for it: pictures and pages as they are, other files and folders as pages that show them. Links are checked with their
anchors; addresses of the web are not visited.
"""
import argparse
import html
import json
import posixpath
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

from markdown_it import MarkdownIt

HERE = Path(__file__).parent
TREE = HERE.parent.parent
SHOWN_AS_THEY_ARE = {".png", ".svg", ".jpg", ".html", ".css", ".js"}
WEB = re.compile(r"^[a-z][a-z0-9+.-]*:")
NOT_SOURCES = {"build", "out", ".git", ".github"}


def page_of(path):
    """Where the page of a Markdown file, or the page that shows another file or a folder, lies."""
    if path == "README.md":
        return "index.html"
    if path.endswith(".md"):
        return path[:-3] + ".html"
    if (TREE / path).is_dir():
        return posixpath.join(path, "index.html")
    return path if posixpath.splitext(path)[1] in SHOWN_AS_THEY_ARE else path + ".html"


def anchor_of(heading, taken):
    """The anchor that GitHub gives a heading."""
    slug = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
    count = taken.get(slug, 0)
    taken[slug] = count + 1
    return f"{slug}-{count}" if count else slug


class Site:
    def __init__(self, out, reference):
        self.out, self.reference = out, reference
        self.sections = []  # of the search: page, anchor, title, heading, text
        self.shown = set()  # files and folders that pages point to
        self.menu = []  # (page, title) in the order of docs/README.md; a group of pages has a title alone
        self.template = (HERE / "page.html").read_text()

    def write(self, place, title, body):
        """Writes a page with head, menu and search."""
        up = "../" * place.count("/")
        menu = "".join(
            f'<li><a href="{up}{page}"{" aria-current=page" if page == place else ""}>{html.escape(text.split(":")[0])}</a></li>'
            if page
            else f"<li class=group>{html.escape(text)}</li>"
            for page, text in self.menu
        )
        text = self.template.replace("@UP@", up).replace("@TITLE@", html.escape(title)).replace("@MENU@", menu)
        file = self.out / place
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text.replace("@BODY@", body))

    def target(self, link, folder):
        """A link of a page in `folder` as the site has it."""
        if WEB.match(link) or link.startswith("#"):
            return link
        path, _, anchor = link.partition("#")
        path = posixpath.normpath(posixpath.join(folder, path))
        if path.startswith("..") or not (TREE / path).exists():
            return link  # the check of links says so
        if not path.endswith(".md"):
            self.shown.add(path)
        page = posixpath.relpath(page_of(path), folder or ".")
        return page + ("#" + anchor if anchor else "")

    def markdown(self, path):
        """Writes the page of a Markdown file."""
        folder, place = posixpath.dirname(path), page_of(path)
        parser = MarkdownIt("commonmark").enable("table")
        tokens = parser.parse((TREE / path).read_text())
        title, taken = title_of(path), {}
        section = [place, "", title, title, []]
        self.sections.append(section)
        for at, token in enumerate(tokens):
            if token.type == "heading_open":
                heading = plain(tokens[at + 1])
                anchor = anchor_of(heading, taken)
                token.attrs["id"] = anchor
                if token.tag != "h1":
                    section = [place, anchor, title, heading, []]
                    self.sections.append(section)
            elif token.type == "inline":
                section[4].append(plain(token))
                for child in token.children:
                    for key in ("href", "src"):
                        if key in child.attrs:
                            child.attrs[key] = self.target(unquote(child.attrs[key]), folder)
            elif token.type in ("fence", "code_block"):
                section[4].append(token.content)
            if token.type in ("html_block", "html_inline") or token.type == "inline" and "<" in token.content:
                for child in token.children or [token]:
                    if child.type in ("html_block", "html_inline"):
                        child.content = re.sub(
                            r'(src|href)="([^"]*)"', lambda m: f'{m[1]}="{self.target(m[2], folder)}"', child.content
                        )
        body = parser.renderer.render(tokens, parser.options, {})
        body = body.replace("<table>", '<div class="wide"><table>').replace("</table>", "</table></div>")
        self.write(place, title, body)

    def show(self, path):
        """Copies a file that pages point to, or writes a page that shows it; of a folder, its files."""
        file, place = TREE / path, page_of(path)
        if file.is_dir():
            names = sorted(child.name for child in file.iterdir() if not child.name.startswith("."))
            tracked = subprocess.run(["git", "ls-files", "--", path], cwd=TREE, capture_output=True, text=True)
            if tracked.returncode == 0:
                known = {posixpath.relpath(name, path).split("/")[0] for name in tracked.stdout.splitlines()}
                names = [name for name in names if name in known]
            items = "".join(f"<li><code>{html.escape(name)}</code></li>" for name in names)
            self.write(place, path + "/", f"<h1>{html.escape(path)}/</h1><ul>{items}</ul>")
        elif place == path:
            (self.out / place).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, self.out / place)
        else:
            text = html.escape(file.read_text(errors="replace"))
            self.write(place, path, f"<h1>{html.escape(path)}</h1><pre><code>{text}</code></pre>")

    def manual(self, file):
        """Writes the page of a manual page as a terminal shows it, for groff's own HTML is not part of groff-base."""
        name = Path(file).name
        place = f"man/{name}.html"
        made = subprocess.run(["groff", "-mandoc", "-Tutf8", "-P-cbou", "-rLL=72n", file], capture_output=True, text=True, check=True)
        self.sections.append([place, "", name, name, [made.stdout]])
        self.write(place, name, f"<pre>{html.escape(made.stdout)}</pre>")
        return place, name

    def search(self):
        """Writes what search.js looks through: a script, which pages opened as files may load too."""
        rows = [[page, anchor, title, heading, re.sub(r"\s+", " ", " ".join(text))] for page, anchor, title, heading, text in self.sections]
        (self.out / "search-index.js").write_text("const sections = " + json.dumps(rows, ensure_ascii=False) + ";\n")
        for name in ("search.js", "style.css"):
            shutil.copyfile(HERE / name, self.out / name)


def plain(token):
    """The text of an inline token, without marks."""
    return "".join(
        " " if child.type in ("softbreak", "hardbreak") else child.content
        for child in token.children
        if child.type in ("text", "code_inline", "softbreak", "hardbreak")
    )


def title_of(path):
    """The first heading of a Markdown file."""
    for line in (TREE / path).read_text().splitlines():
        if line.startswith("# "):
            return line[2:].replace("`", "")
    return path


class Links(HTMLParser):
    """The links and the anchors of a page."""

    def __init__(self, text):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for key, value in attributes:
            if key == "id" or key == "name" and tag == "a":
                self.anchors.add(value)
            elif key in ("href", "src") and tag != "base":
                self.links.append(value or "")


def check(out, pages):
    """What leads nowhere, a line each."""
    read = {}

    def links_of(place):
        if place not in read:
            read[place] = Links((out / place).read_text(errors="replace"))
        return read[place]

    for place in pages:
        for link in links_of(place).links:
            if WEB.match(link):
                continue
            path, _, anchor = link.partition("#")
            target = posixpath.normpath(posixpath.join(posixpath.dirname(place), unquote(path))) if path else place
            if not (out / target).is_file():
                yield f"{place}: nothing is at '{link}'"
            elif anchor and target.endswith(".html") and unquote(anchor) not in links_of(target).anchors:
                yield f"{place}: '{link}': the page has no such heading"


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("out", type=Path)
    arguments.add_argument("--reference")
    arguments.add_argument("--manual", action="append", default=[])
    told = arguments.parse_args()
    site = Site(told.out, told.reference)
    found = (path.relative_to(TREE) for path in TREE.rglob("*.md"))
    sources = sorted(path.as_posix() for path in found if path.parts[0] not in NOT_SOURCES)
    # The menu is the index's list with its headings: each page once, at its first link.
    for heading, link in re.findall(r"^## (.*)|\]\(([^)#]*\.md)[^)]*\)", (TREE / "docs/README.md").read_text(), re.MULTILINE):
        if heading:
            site.menu.append((None, heading))
            continue
        path = posixpath.normpath(posixpath.join("docs", link))
        if path in sources and (page_of(path), title_of(path)) not in site.menu:
            site.menu.append((page_of(path), title_of(path)))
    site.menu[1:1] = [("docs/README.html", title_of("docs/README.md"))]
    if told.reference:
        site.menu.append((told.reference, "Reference of the C interface"))
    for file in told.manual:
        if not shutil.which("groff"):
            print("site.sh: without manual pages: there is no groff", file=sys.stderr)
            break
        site.menu.append(site.manual(file))
    for path in sources:
        site.markdown(path)
    for path in sorted(site.shown):
        site.show(path)
    site.search()
    pages = [page_of(path) for path in sources] + ([told.reference] if told.reference else [])
    wrong = sorted(set(check(told.out, pages)))
    for line in wrong:
        print("site.sh:", line, file=sys.stderr)
    print(f"{len(sources)} pages, {len(site.shown)} files that they point to: {told.out / 'index.html'}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
