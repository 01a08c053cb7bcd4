"""Typesets the equations of a built site in a browser: `python equations.py FOLDER`. What MathJax cannot read is an error.

Sphinx passes equations on as they are; only the browser finds a misspelt command, and shows it in red.
"""

import shutil
import sys
from pathlib import Path

FIND_MISTAKES = """
const done = arguments[arguments.length - 1];
const equations = () => [...MathJax.startup.document.math];
const unreadable = item => !item.typesetRoot || item.typesetRoot.querySelector('[data-mml-node="merror"], [fill="red"]');
const late = new Promise(resolve => setTimeout(resolve, 20000));
Promise.race([MathJax.startup.promise, late]).then(
  () => done(equations().filter(unreadable).map(item => item.math)),
  error => done(['anything: ' + error.message]));
"""


def browser():
    """Chromium or Chrome without a window, or the reason why there is none."""
    try:
        from selenium import webdriver
    except ImportError:
        return "Selenium is not installed: pip install selenium"
    program = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    driver = shutil.which("chromedriver")
    if not (program and driver):
        return "there is no Chromium with chromedriver: apt-get install chromium chromium-driver"
    options = webdriver.ChromeOptions()
    options.binary_location = program
    # as root in a container; what is loaded are the pages of the site
    for option in ("--headless=new", "--no-sandbox"):
        options.add_argument(option)
    return webdriver.Chrome(options=options, service=webdriver.ChromeService(driver))


def mistakes(folder):
    """Equations that MathJax cannot read, as (page, TeX); or the reason why nobody has looked."""
    folder = Path(folder).resolve()
    pages = [path for path in sorted(folder.rglob("*.html")) if "tex-svg-full.js" in path.read_text(encoding="utf-8")]
    session = browser()
    if isinstance(session, str):
        return session
    try:
        found = []
        for page in pages:
            session.get(page.as_uri())
            found += [(str(page.relative_to(folder)), tex) for tex in session.execute_async_script(FIND_MISTAKES)]
        return found
    finally:
        session.quit()


if __name__ == "__main__":
    found = mistakes(sys.argv[1])
    if isinstance(found, str):
        print(f"note: the equations were not checked; {found}")
        raise SystemExit(0)
    for name, tex in found:
        print(f"{name}: MathJax cannot read {' '.join(tex.split())}")
    raise SystemExit(bool(found))
