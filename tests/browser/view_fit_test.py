#!/usr/bin/python3
"""What the view of report.html is fitted to, on screens of all sizes, in headless Chromium.

Usage: view_fit_test.py CAROM
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

from browser import browser, open_report, picture
from selenium.webdriver.common.by import By

CASES = pathlib.Path(__file__).resolve().parents[2] / "cases"

# A cube of 0.1 m that flies on by 2 m; beside it there is nothing.
FLIES_ON = """
title = "A cube flies on"
units = "SI"

[[mesh.block]]
size = [0.1, 0.1, 0.1]
divisions = [2, 2, 2]
groups = { cells = "CUBE" }

[materials.rubber]
law = "neo_hookean"
E = 1.0e6
nu = 0.3
rho = 1000.0

[[part]]
name = "cube"
cells = "CUBE"
material = "rubber"

[[initial]]
part = "cube"
velocity = [20.0, 0.0, 0.0]

[scheme]
kind = "central_differences"

[time]
end = 0.1
"""

# The rows on which what is seen of the panel stands: their middles, since controls of a row differ in height.
ROWS = """
const rows = [];
for (const control of document.querySelectorAll(".panel :is(select, input, button)")) {
  const box = control.getBoundingClientRect(), middle = (box.top + box.bottom) / 2;
  if (box.height > 0 && !rows.some((row) => Math.abs(row - middle) < 8)) rows.push(middle);
}
return rows.length;
"""


class Fit(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def run_case(self, name, case):
        results = pathlib.Path(self.folder.name) / name
        subprocess.run([CAROM, "run", case, "--out", results, "--threads", "1", "--quiet"], check=False)
        return results / "report.html"

    def test_the_picture_goes_with_a_body_that_flies_on(self):
        case = pathlib.Path(self.folder.name) / "flies_on.toml"
        case.write_text(FLIES_ON, encoding="utf-8")
        page = self.run_case("flies_on", case)
        for webgl in (True, False):
            with self.subTest(webgl=webgl), browser(1200, 1000, webgl=webgl) as driver:
                open_report(driver, page)
                canvas = driver.find_element(By.CSS_SELECTOR, ".stage canvas")
                boxes = []
                for time in (0, 0.05, 0.1):
                    driver.execute_script("carom.show(arguments[0])", time)
                    boxes.append(picture(driver, canvas))
                for box in boxes:  # the cube does not turn: its picture is the same, but for the rounding of 2 m / 65535
                    for side in ("left", "right", "top", "bottom"):
                        self.assertAlmostEqual(box[side], boxes[0][side], delta=2)
                self.assertGreater(boxes[0]["bottom"] - boxes[0]["top"], 0.5 * boxes[0]["height"])

    def test_a_slide_that_is_as_long_as_a_few_bodies_stays_in_the_picture(self):
        page = self.run_case("slide", CASES / "friction/deformable_bathe.toml")
        with browser(1200, 1000) as driver:
            open_report(driver, page)
            driver.find_element(By.XPATH, "//button[text()='ground' or text()='floor' or text()='wall']").click()
            canvas = driver.find_element(By.CSS_SELECTOR, ".stage canvas")
            for frame in ("0", "carom.t", "1e9"):
                driver.execute_script(f"carom.show({frame})")
                box = picture(driver, canvas)
                self.assertGreater(box["left"], 0.01 * box["width"])
                self.assertLess(box["right"], 0.99 * box["width"])

    def test_bodies_of_bars_open_without_complaint(self):
        """Their surface encloses nothing that a cut could fill."""
        page = self.run_case("bars", CASES / "friction/incline_over_moreau_jean.toml")
        with browser(420, 900) as driver:
            open_report(driver, page)  # fails of what the console says

    def test_a_small_screen_has_four_rows_of_controls_and_unfolds_the_rest(self):
        page = self.run_case("rows", CASES / "hertz/impact_solid.toml")
        with browser(420, 900) as driver:
            open_report(driver, page)
            self.assertLessEqual(driver.execute_script(ROWS), 4)
            driver.find_element(By.XPATH, "//button[text()='more']").click()
            self.assertGreater(driver.execute_script(ROWS), 4)
            driver.find_element(By.XPATH, "//button[text()='PNG']")
            driver.find_element(By.XPATH, "//button[text()='less']").click()
            self.assertLessEqual(driver.execute_script(ROWS), 4)
            self.assertLessEqual(driver.execute_script("return document.documentElement.scrollWidth"), 420)
        with browser(1200, 900) as driver:
            open_report(driver, page)
            self.assertFalse(driver.find_element(By.XPATH, "//button[text()='more']").is_displayed())
            self.assertTrue(driver.find_element(By.XPATH, "//button[text()='PNG']").is_displayed())


if __name__ == "__main__":
    CAROM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
