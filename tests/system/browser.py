"""A headless browser for tests, or the reason why there is none."""

import shutil
from contextlib import contextmanager

import pytest

_OPTIONS = (
    "--headless=new",
    # as root in a container; what is loaded are the pages of the tests
    "--no-sandbox",
    "--window-size=1300,800",
    "--hide-scrollbars",
    # OpenGL by the processor
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)


@contextmanager
def open_browser():
    """Chromium or Chrome, driven by Selenium; skips the test where something of it is missing."""
    webdriver = pytest.importorskip("selenium.webdriver", reason="Selenium is not installed: pip install selenium")
    browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    driver = shutil.which("chromedriver")
    if not (browser and driver):
        pytest.skip("there is no Chromium with chromedriver: apt-get install chromium chromium-driver")
    options = webdriver.ChromeOptions()
    options.binary_location = browser
    for option in _OPTIONS:
        options.add_argument(option)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    session = webdriver.Chrome(options=options, service=webdriver.ChromeService(driver))
    try:
        yield session
    finally:
        session.quit()
