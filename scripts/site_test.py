#!/usr/bin/env python3
"""Opens every page of the built site in headless Chromium, for scripts/site --test.

site_test.py HTML_FOLDER [PICTURES]

Fails where a link leads nowhere or to a place that a page does not have, a picture is not shown, the console has an error, a
page of 400 pixels' width has to be scrolled sideways, or search does not find words in the page that has them. PICTURES: folder for
screenshots, 400 pixels wide.
"""
import functools
import http.server
import pathlib
import sys
import threading
import time
import urllib.parse

from selenium import webdriver

NARROW, WIDE, HEIGHT = 400, 1280, 900
# Words and the page that the search is to find among its first results: of a how-to page, of messages, of both interfaces.
SEARCHED = {"skip-existing": "farm.html", "turned-away terminator": "terminator.html",
            "KHR_texture_basisu": "messages.html", "camera_for_whole_scene": "api/scene.html", "amodal_masks": "python-api.html"}

# What a page has: links, anchors, pictures that are not shown, what is wider than the window.
LOOK = """
const wide = document.documentElement.clientWidth;
const scrolls = e => {
  for (let p = e.parentElement; p; p = p.parentElement)
    if (getComputedStyle(p).overflowX !== 'visible') return true;
  return false;
};
return {
  links: [...document.querySelectorAll('a[href]')].map(a => a.href),
  anchors: [...document.querySelectorAll('[id], a[name]')].map(e => e.id || e.name),
  dark: [...document.images].filter(i => i.complete && i.naturalWidth === 0).map(i => i.src),
  late: [...document.images].filter(i => !i.complete).length,
  width: document.documentElement.scrollWidth, window: wide,
  wide: [...document.body.querySelectorAll('*')].filter(e => e.getBoundingClientRect().right > wide + 1 && !scrolls(e))
    .slice(0, 3).map(e => e.tagName + ' ' + e.textContent.trim().slice(0, 60)),
  text: document.body.innerText.length,
};
"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


def open_browser():
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--disable-background-networking"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(options=options, service=webdriver.ChromeService("/usr/bin/chromedriver"))


def set_width(browser, width):
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                            {"width": width, "height": HEIGHT, "deviceScaleFactor": 1, "mobile": width == NARROW})


def look(browser, address):
    browser.get(address)
    for _ in range(50):
        seen = browser.execute_script(LOOK)
        if not seen["late"]:
            break
        time.sleep(0.1)
    return seen


def test_pages(browser, root, base, pictures):
    """What is wrong with the pages; every one is opened twice."""
    wrong, links, anchors = [], {}, {}
    for file in sorted(root.rglob("*.html")):
        page = file.relative_to(root).as_posix()
        for width in (WIDE, NARROW):
            set_width(browser, width)
            seen = look(browser, base + page)
            wrong += [f"{page}: picture {source}" for source in seen["dark"]]
            if seen["late"] or seen["text"] < 40:
                wrong.append(f"{page}: it does not load")
            wrong += [f"{page}: console: {entry['message']}" for entry in browser.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")]
        if seen["width"] > NARROW or seen["window"] != NARROW or seen["wide"]:
            wrong.append(f"{page}: {seen['width']} pixels wide: {seen['wide']}")
        links[page], anchors[page] = seen["links"], set(seen["anchors"])
        if pictures:
            browser.save_screenshot(str(pictures / (page.replace("/", "-") + ".png")))
    for page, targets in links.items():
        for target in sorted(set(targets)):
            if not target.startswith(base):
                continue  # elsewhere on the network
            name, _, anchor = target[len(base):].partition("#")
            name = urllib.parse.unquote(name.partition("?")[0])
            name = name + "index.html" if name in ("", "api/") else name
            if not (root / name).is_file():
                wrong.append(f"{page}: links to {name}, which is not there")
            elif anchor and name in anchors and urllib.parse.unquote(anchor) not in anchors[name]:
                wrong.append(f"{page}: links to {name}#{anchor}, which is not there")
    return wrong, len(links)


def test_search(browser, base):
    wrong = []
    set_width(browser, WIDE)
    for words, page in SEARCHED.items():
        browser.get(base)
        field = browser.find_element("css selector", ".md-search__input")
        browser.execute_script("arguments[0].focus()", field)
        field.send_keys(words)
        found = []
        for _ in range(50):
            time.sleep(0.1)
            found = browser.execute_script("return [...document.querySelectorAll('a.md-search-result__link')].map(a => a.href)")[:8]
            if found and page and any(page in link for link in found):
                break
        if page and not any(page in link for link in found):
            wrong.append(f"search: '{words}' does not find {page} but {found}")
    return wrong


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    pictures = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
    if pictures:
        pictures.mkdir(parents=True, exist_ok=True)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=root))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    base = f"http://127.0.0.1:{server.server_port}/"
    browser = open_browser()
    try:
        wrong, count = test_pages(browser, root, base, pictures)
        wrong += test_search(browser, base)
    finally:
        browser.quit()
    print("\n".join(wrong))
    print(f"{count} pages, {len(SEARCHED)} searches, {len(wrong)} faults")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
