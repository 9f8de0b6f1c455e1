# SPDX-License-Identifier: LGPL-3.0-or-later
"""Chromium without a screen, drawing in software, on pages from the disk."""

import base64
import contextlib
import os
import shutil

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

CHROMIUM = shutil.which("chromium")
DRIVER = shutil.which("chromedriver")


def options(width, height):
    """No network is needed: names of hosts lead nowhere."""
    chosen = Options()
    chosen.binary_location = CHROMIUM
    for argument in [
        "--headless=new",
        f"--window-size={width},{height}",
        "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader",
        "--ignore-gpu-blocklist",
        "--hide-scrollbars",
        "--force-device-scale-factor=1",
        "--disable-dev-shm-usage",
        "--host-resolver-rules=MAP * ~NOTFOUND",
    ]:
        chosen.add_argument(argument)
    if os.geteuid() == 0:  # its sandbox refuses to run as root
        chosen.add_argument("--no-sandbox")
    chosen.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return chosen


class Page:
    """A report in the browser."""

    def __init__(self, driver, path):
        self.driver = driver
        driver.get(path.resolve().as_uri())
        self.wait("window.rubato && rubato.ready")

    def run(self, script, *arguments):
        """What a script returns."""
        return self.driver.execute_script(f"return ({script})", *arguments)

    def wait(self, condition, longest=280):
        """Until a condition holds and all updates of the view are drawn."""
        done = self.driver.execute_async_script(
            f"""const done = arguments[0], end = performance.now() + {1000 * longest};
            const ask = () => ({condition}) ? done(true) : performance.now() > end ? done(false) : setTimeout(ask, 20);
            ask();"""
        )
        assert done, f"{condition} did not come true: {self.messages()}"

    def settle(self):
        """Until the view has drawn what was asked for."""
        failure = self.driver.execute_async_script(
            """const done = arguments[0];
            rubato.viewer.updates.then(() => requestAnimationFrame(() => requestAnimationFrame(() => done(""))),
                                       (error) => done(String(error)));"""
        )
        assert failure == ""

    def messages(self):
        """What the console has, errors and warnings alike."""
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def pixels(self, pane=0):
        """The pixels of a view as one list of numbers: red, green, blue and opacity of each."""
        self.settle()
        text = self.driver.execute_script(
            """const canvas = rubato.viewer.panes[arguments[0]].picture.canvas;
            const copy = document.createElement("canvas");
            copy.width = canvas.width; copy.height = canvas.height;
            copy.getContext("2d").drawImage(canvas, 0, 0);
            const bytes = copy.getContext("2d").getImageData(0, 0, copy.width, copy.height).data;
            let letters = "";
            for (let i = 0; i < bytes.length; i += 8192) letters += String.fromCharCode(...bytes.subarray(i, i + 8192));
            return btoa(letters);""",
            pane,
        )
        return base64.b64decode(text)


@contextlib.contextmanager
def chromium(width=1366, height=900):
    driver = webdriver.Chrome(service=Service(DRIVER), options=options(width, height))
    driver.set_script_timeout(300)
    driver.set_page_load_timeout(300)
    try:
        yield driver
    finally:
        driver.quit()
