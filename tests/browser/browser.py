"""Headless Chromium on pages of the disk, as the tests of the report drive it."""

import base64
import contextlib
import time

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

PATIENCE = 60.0  # s: software rendering on a loaded machine

FLAGS = ("--headless=new", "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage", "--use-angle=swiftshader",
         "--enable-unsafe-swiftshader", "--hide-scrollbars")


@contextlib.contextmanager
def browser(width=1200, height=1000, dark=False, webgl=True):
    """A browser window of this size, with or without WebGL, for a reader who likes it dark or light."""
    options = Options()
    options.binary_location = "/usr/bin/chromium"
    for flag in (*FLAGS, f"--window-size={width},{height}", *(() if webgl else ("--disable-3d-apis",))):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    driver.set_script_timeout(PATIENCE)
    try:
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]})
        driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600})
        yield driver
    finally:
        driver.quit()


def wait_for(driver, condition, *arguments):
    """Until a JavaScript expression is true; what it is then."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        found = driver.execute_script("return " + condition, *arguments)
        if found:
            return found
        time.sleep(0.05)
    raise AssertionError(f"not within {PATIENCE:g} s: {condition}")


def open_report(driver, path):
    """A page from the disk, once its views are drawn; fails where the page has complained on its console."""
    driver.get(f"file://{path}")
    wait_for(driver, "[...document.querySelectorAll('[data-view]')].every((s) => 'ready' in s.dataset)")
    complaints = [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
    if complaints:
        raise AssertionError(f"{path}: {complaints}")


# Of the pixels of a canvas that are not transparent: how many, and the box around them as shares of the canvas.
PICTURE = """
const canvas = arguments[0], copy = document.createElement("canvas");
const width = copy.width = canvas.width, height = copy.height = canvas.height;
const context = copy.getContext("2d");
context.drawImage(canvas, 0, 0);
const data = context.getImageData(0, 0, width, height).data;
let count = 0, left = width, right = -1, top = height, bottom = -1, hash = 0;
for (let y = 0; y < height; y++) {
  for (let x = 0; x < width; x++) {
    const i = 4 * (y * width + x);
    if (data[i + 3] < 128) continue;
    count++;
    hash = (hash * 31 + data[i] * 65536 + data[i + 1] * 256 + data[i + 2]) >>> 0;
    left = Math.min(left, x), right = Math.max(right, x + 1), top = Math.min(top, y), bottom = Math.max(bottom, y + 1);
  }
}
return {count, hash, width, height, left, right, top, bottom};
"""


def picture(driver, canvas):
    return driver.execute_script(PICTURE, canvas)


# What a click on a button saves: the links that would be downloaded are kept instead.
KEEP_DOWNLOADS = """
window.kept = [];
HTMLAnchorElement.prototype.click = function () {
  const name = this.download;
  fetch(this.href).then((r) => r.blob()).then((b) => new Promise((done) => {
    const reader = new FileReader();
    reader.onload = () => done(reader.result.split(",")[1]);
    reader.readAsDataURL(b);
  })).then((data) => window.kept.push([name, data]));
};
"""


def saved(driver, button):
    """Name and bytes of the file that a click saves."""
    driver.execute_script(KEEP_DOWNLOADS)
    button.click()
    name, data = wait_for(driver, "window.kept[0]")
    return name, base64.b64decode(data)
