#!/usr/bin/python3
"""The view of report.html in headless Chromium: what is drawn, where, and what clicks and keys do.

Usage: view_test.py CAROM
"""

import csv
import io
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

from browser import browser, open_report, picture, saved, wait_for
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select

# A block of 0.2 x 0.1 x 0.1 m above one of 0.1 x 0.1 x 0.1 m, in a shared origin of x and y; the upper one falls.
CASE = """
title = "Two blocks and a floor"
units = "SI"

[[mesh.block]]
origin = [0.0, 0.0, 0.0]
size = [0.1, 0.1, 0.1]
divisions = [2, 2, 2]
groups = { cells = "LOW", zmin = "FOOT", zmax = "HEAD" }

[[mesh.block]]
origin = [0.0, 0.0, 0.11]
size = [0.2, 0.1, 0.1]
divisions = [4, 2, 2]
groups = { cells = "HIGH", zmin = "SOLE" }

[materials.rubber]
law = "neo_hookean"
E = 1.0e6
nu = 0.3
rho = 1000.0

[[part]]
name = "low"
cells = "LOW"
material = "rubber"

[[part]]
name = "high"
cells = "HIGH"
material = "rubber"

[[initial]]
part = "high"
velocity = [0.0, 0.0, -1.0]

[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]

[[contact]]
name = "blocks"
kind = "pair"
group = "SOLE"
master = "HEAD"

[scheme]
kind = "central_differences"

[time]
end = 0.02

[[probe]]
name = "top"
node = 60
quantities = ["displacement"]
"""

# A row of four cubes of 0.1 m, three of which go in the middle of the run.
ERODED = """
title = "A bar of which a cube stays"
units = "SI"

[[mesh.block]]
origin = [0.0, 0.0, 0.0]
size = [0.1, 0.1, 0.1]
divisions = [1, 1, 1]
groups = { cells = "STAYS" }

[[mesh.block]]
origin = [0.1, 0.0, 0.0]
size = [0.3, 0.1, 0.1]
divisions = [3, 1, 1]
groups = { cells = "GOES" }

[materials.rubber]
law = "neo_hookean"
E = 1.0e6
nu = 0.3
rho = 1000.0

[[part]]
name = "stays"
cells = "STAYS"
material = "rubber"

[[part]]
name = "goes"
cells = "GOES"
material = "rubber"

[[erosion]]
part = "goes"
time = 0.01

[scheme]
kind = "central_differences"

[time]
end = 0.02
"""

# A quarter of a block that falls onto a wall: cut along x = 0 and y = 0.
QUARTER = """
title = "Quarter of a block"
units = "SI"

[[mesh.block]]
origin = [0.0, 0.0, 0.0]
size = [0.05, 0.05, 0.1]
divisions = [2, 2, 4]
groups = { cells = "BLOCK", xmin = "LEFT", ymin = "FRONT", zmin = "FOOT" }

[materials.rubber]
law = "neo_hookean"
E = 1.0e6
nu = 0.3
rho = 1000.0

[[part]]
name = "block"
cells = "BLOCK"
material = "rubber"

[[initial]]
part = "block"
velocity = [0.0, 0.0, -1.0]

[[support]]
nodes = "LEFT"
symmetry = "x"

[[support]]
nodes = "FRONT"
symmetry = "y"

[[contact]]
name = "wall"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]

[scheme]
kind = "central_differences"

[time]
end = 0.01
"""

SIZE = (1200, 1000)

PIXEL = """
const copy = document.createElement("canvas"), source = arguments[0];
copy.width = source.width, copy.height = source.height;
const context = copy.getContext("2d");
context.drawImage(source, 0, 0);
return [...context.getImageData(Math.round(arguments[1]), Math.round(arguments[2]), 1, 1).data];
"""


class View(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        case = pathlib.Path(cls.folder.name) / "two_blocks.toml"
        case.write_text(CASE, encoding="utf-8")
        cls.results = pathlib.Path(cls.folder.name) / "results"
        subprocess.run([CAROM, "run", case, "--out", cls.results, "--quiet"], check=False)
        cls.page = cls.results / "report.html"
        cls.context = browser(*SIZE)
        cls.driver = cls.context.__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.context.__exit__(None, None, None)
        cls.folder.cleanup()

    def setUp(self):
        open_report(self.driver, self.page)
        self.canvas = self.driver.find_element(By.CSS_SELECTOR, ".stage canvas")
        self.driver.execute_script("arguments[0].scrollIntoView()", self.driver.find_element(By.CSS_SELECTOR, ".view"))
        self.go_to(0)

    def go_to(self, frame):
        self.driver.execute_script(
            "const s = document.querySelector('.time input'); s.value = arguments[0]; s.dispatchEvent(new Event('input'))",
            frame)

    def press(self, *keys):
        self.driver.execute_script("arguments[0].focus()", self.canvas)
        ActionChains(self.driver).send_keys(*keys).perform()

    def panel(self, text):
        return self.driver.find_element(By.XPATH, f"//div[@class='panel']//button[text()='{text}']")

    def labelled(self, text):
        return self.driver.find_element(By.XPATH, f"//div[@class='panel']//label[contains(., '{text}')]/input")

    def hide_floor(self):
        self.panel("floor").click()

    def seen(self):
        return picture(self.driver, self.canvas)

    def look_along_y(self):
        """Bodies alone, without what stands out of them, seen from the front: x to the right, z upward."""
        self.hide_floor()
        if self.driver.find_elements(By.XPATH, "//label[contains(., 'contact forces')]"):
            self.labelled("contact forces").click()
        self.panel("y").click()
        return self.seen()

    def frame(self):
        return int(self.driver.execute_script("return document.querySelector('.time input').value"))

    def clock(self):
        return self.driver.find_element(By.CSS_SELECTOR, ".clock").text

    def test_the_outline_is_that_of_the_bodies(self):
        # At the beginning: 0.2 m wide, 0.21 m high, whole. A pixel on each side for edges and rounding.
        box = self.look_along_y()
        wide, high = box["right"] - box["left"], box["bottom"] - box["top"]
        unit = high / 0.21
        self.assertAlmostEqual(wide, 0.2 * unit, delta=3)
        full = unit**2 * (0.2 * 0.1 + 0.1 * 0.1)
        self.assertLess(abs(box["count"] - full), 0.02 * full)  # the edges' pixels

    def test_a_cut_takes_half_away(self):
        whole = self.look_along_y()
        cut = Select(self.driver.find_element(By.XPATH, "//select[@title='Cut the bodies open']"))
        cut.select_by_value("x")
        low = self.driver.execute_script("return document.querySelector('.panel input[type=range]').hidden")
        self.assertFalse(low)
        half = self.seen()
        self.panel("other half").click()
        other = self.seen()
        # Bodies reach from 0 to 0.2 m (and a little farther as they bulge): the cut in the middle leaves x < 0.1 m.
        unit = (whole["right"] - whole["left"]) / 0.2
        self.assertAlmostEqual(half["right"], whole["left"] + 0.1 * unit, delta=0.01 * unit)
        self.assertAlmostEqual(other["left"], whole["left"] + 0.1 * unit, delta=0.01 * unit)
        cut.select_by_value("")
        self.assertEqual(self.seen()["count"], whole["count"])

    def test_parts_go_and_come_back(self):
        whole = self.look_along_y()
        self.panel("high").click()
        low = self.seen()
        self.assertAlmostEqual((low["right"] - low["left"]) / (whole["right"] - whole["left"]), 0.5, delta=0.02)
        self.assertAlmostEqual((low["bottom"] - low["top"]) / (whole["bottom"] - whole["top"]), 0.1 / 0.21, delta=0.02)
        self.panel("high").click()
        self.assertEqual(self.seen()["hash"], whole["hash"])

    def test_time_moves_the_bodies(self):
        first = self.look_along_y()
        last = self.driver.execute_script("return Number(document.querySelector('.time input').max)")
        seen = {first["hash"]}
        for frame in (last // 2, last):
            self.go_to(frame)
            seen.add(self.seen()["hash"])
        self.assertEqual(len(seen), 3)
        self.assertEqual(self.clock(), "t = 20 ms")

    def test_keys(self):
        self.press(Keys.END)
        last = self.frame()
        self.assertGreater(last, 10)
        self.press(Keys.LEFT)
        self.assertEqual(self.frame(), last - 1)
        self.press(Keys.HOME)
        self.assertEqual(self.frame(), 0)
        self.press(Keys.RIGHT, Keys.RIGHT)
        self.assertEqual(self.frame(), 2)
        self.look_along_y()
        self.press("f")
        front = self.seen()
        self.press("x")
        side = self.seen()
        self.assertAlmostEqual((side["right"] - side["left"]) / (front["right"] - front["left"]), 0.5, delta=0.02)
        self.press("y")
        self.assertEqual(self.seen()["hash"], front["hash"])
        self.press("-")
        self.assertAlmostEqual((front["bottom"] - front["top"]) / (self.seen()["bottom"] - self.seen()["top"]), 1.2, delta=0.02)
        self.press("+")
        self.assertEqual(self.seen()["hash"], front["hash"])
        self.press("f")
        self.assertEqual(self.seen()["hash"], front["hash"])
        self.press("e")
        self.assertNotEqual(self.seen()["hash"], front["hash"])
        self.press("e")
        self.assertEqual(self.seen()["hash"], front["hash"])
        ActionChains(self.driver).key_down(Keys.SHIFT).send_keys(Keys.LEFT).key_up(Keys.SHIFT).perform()
        self.assertEqual(self.frame(), 2)
        self.assertNotEqual(self.seen()["hash"], front["hash"])
        self.press(Keys.SPACE)
        wait_for(self.driver, "Number(document.querySelector('.time input').value) > 2")
        self.press(Keys.SPACE)
        stopped = self.frame()
        self.assertGreater(stopped, 2)

    def test_dragging_turns_and_the_wheel_zooms(self):
        before = self.seen()
        ActionChains(self.driver).drag_and_drop_by_offset(self.canvas, 80, 30).perform()
        turned = self.seen()
        self.assertNotEqual(turned["hash"], before["hash"])
        self.assertEqual(self.driver.find_elements(By.CSS_SELECTOR, ".mark-of-node"), [])  # dragging is not clicking
        self.driver.execute_script("arguments[0].dispatchEvent(new WheelEvent('wheel', {deltaY: -500, bubbles: true}))",
                                   self.canvas)
        self.assertGreater(self.seen()["bottom"] - self.seen()["top"], turned["bottom"] - turned["top"])

    def test_a_click_names_node_and_cell_and_draws_their_curve(self):
        box = self.look_along_y()
        unit = (box["right"] - box["left"]) / 0.2
        # Close to the corner (0.2, 0, 0.21): node 72 - 3 of the upper block's 5 x 3 x 3 after the lower one's 27, in
        # the cell at its end of the upper row of the front.
        x, y = box["left"] + 0.195 * unit, box["top"] + 0.005 * unit
        size = self.canvas.size
        ActionChains(self.driver).move_to_element_with_offset(
            self.canvas, round(x * size["width"] / box["width"] - size["width"] / 2),
            round(y * size["height"] / box["height"] - size["height"] / 2)).click().perform()
        cells = [c.text for c in self.driver.find_elements(By.CSS_SELECTOR, ".picked tbody td")]
        node = 27 + 2 * 15 + 0 * 5 + 4 + 1
        cell = 8 + 8 + 0 * 4 + 3 + 1
        self.assertEqual(cells[0], f"1: node {node}")
        self.assertEqual(cells[1], str(cell))
        self.assertEqual(cells[2], "high")
        place = [float(v) for v in cells[3].strip("() m").split(",")]
        for found, known in zip(place, (0.2, 0.0, 0.21)):
            self.assertAlmostEqual(found, known, delta=1e-5)
        Select(self.driver.find_element(By.XPATH, "//select[@title='What the colours show']")).select_by_visible_text(
            "velocity z")
        value = self.driver.find_elements(By.CSS_SELECTOR, ".picked tbody td")[4].text
        self.assertEqual(value, "-1 m/s")
        self.assertEqual(len(self.driver.find_elements(By.CSS_SELECTOR, ".mark-of-node")), 1)
        curve = self.driver.find_element(By.CSS_SELECTOR, ".view figure")
        self.assertTrue(curve.is_displayed())
        self.assertGreater(picture(self.driver, curve.find_element(By.CSS_SELECTOR, "canvas"))["count"], 500)
        self.driver.find_element(By.CSS_SELECTOR, ".picked button").click()
        self.assertEqual(self.driver.find_elements(By.CSS_SELECTOR, ".mark-of-node"), [])
        self.assertFalse(curve.is_displayed())

    def test_view_and_curves_have_one_time(self):
        self.driver.execute_script("carom.show(0.0105)")
        self.assertTrue(self.clock().startswith("t = 10"), self.clock())
        line = self.driver.execute_script(
            "const c = document.querySelector('.chart .cursor'); return [c.hidden, parseFloat(c.style.left)]")
        self.assertFalse(line[0])
        self.go_to(0)
        other = self.driver.execute_script("return parseFloat(document.querySelector('.chart .cursor').style.left)")
        self.assertLess(other, line[1])
        chart = self.driver.find_element(By.CSS_SELECTOR, "[data-chart]")
        self.driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", chart)
        ActionChains(self.driver).move_to_element(chart).click().perform()
        self.assertGreater(self.frame(), 0)

    def test_colours_have_a_legend_in_units(self):
        quantity = Select(self.driver.find_element(By.XPATH, "//select[@title='What the colours show']"))
        self.assertIn("von Mises stress", [o.text for o in quantity.options])
        quantity.select_by_visible_text("von Mises stress")
        self.assertRegex(self.driver.find_element(By.CSS_SELECTOR, ".colours strong").text, r"von Mises stress \[[kM]?Pa\]")
        self.go_to(20)
        stressed = self.seen()
        quantity.select_by_visible_text("parts")
        self.assertFalse(self.driver.find_element(By.CSS_SELECTOR, ".colours").is_displayed())
        self.assertNotEqual(self.seen()["hash"], stressed["hash"])

    def choose(self, title, value):
        Select(self.driver.find_element(By.XPATH, f"//select[@title='{title}']")).select_by_value(value)

    def legend(self):
        return [b.text for b in self.driver.find_elements(By.CSS_SELECTOR, ".colours b")]

    def type_into(self, title, text):
        field = self.driver.find_element(By.XPATH, f"//input[@title='{title}']")
        field.clear()
        field.send_keys(text, Keys.ENTER)

    def test_colours_go_over_what_is_chosen(self):
        # At the beginning the lower block is at rest, and the upper one falls with 1 m/s.
        Select(self.driver.find_element(By.XPATH, "//select[@title='What the colours show']")).select_by_visible_text("speed")
        over = "Which values the colours go over"
        self.choose(over, "instant")
        self.assertEqual((self.legend()[0], self.legend()[-1]), ("1", "0"))
        self.panel("high").click()
        self.choose(over, "visible")
        self.assertEqual(self.legend(), ["0"])
        self.panel("high").click()
        self.choose(over, "given")
        self.type_into("Highest value of the colours", "5")
        self.assertEqual(self.legend(), ["5", "4", "3", "2", "1", "0"])
        plain = self.seen()
        self.type_into("Cells with a larger value are marked", "0.5")
        # Of the 5 x 3 x 3 nodes of the upper block three are inside.
        self.assertEqual(self.driver.find_element(By.CSS_SELECTOR, ".colours em").text, "42 nodes above 0.5")
        self.assertNotEqual(self.seen()["hash"], plain["hash"])
        self.labelled("logarithmic").click()
        self.assertEqual(self.legend(), ["1", "0.1", "0.01", "0.001"])

    def test_values_of_cells_are_averaged(self):
        self.go_to(20)
        plain = self.seen()
        self.labelled("averaged").click()
        self.assertNotEqual(self.seen()["hash"], plain["hash"])
        self.labelled("averaged").click()
        self.assertEqual(self.seen()["hash"], plain["hash"])

    def test_it_opens_at_the_largest_force(self):
        open_report(self.driver, self.page)
        with (self.results / "contact.csv").open(encoding="utf-8") as stream:
            rows = [row for row in csv.reader(stream) if not row[0].startswith("#")]
        force = {name: [rows[0].index(f"{name}.force_{c}") for c in "xyz"] for name in ("floor", "blocks")}
        largest, time = max((sum(float(row[k]) ** 2 for k in columns), float(row[0])) for row in rows[1:] for columns in force.values())
        self.assertGreater(largest, 0)
        times = self.driver.execute_script("return carom.unpack && JSON.parse(document.getElementById('view-0').textContent).times")
        self.assertEqual(self.frame(), min(range(len(times)), key=lambda k: abs(times[k] - time)))
        self.assertGreater(self.frame(), 0)

    def test_edges_of_small_cells_are_not_drawn(self):
        self.look_along_y()
        for _ in range(20):
            self.press("-")
        far = self.seen()
        self.press("e")
        self.assertEqual(self.seen()["hash"], far["hash"])
        for _ in range(20):
            self.press("+")
        without = self.seen()
        self.press("e")
        self.assertNotEqual(self.seen()["hash"], without["hash"])

    def test_a_cut_is_filled_with_the_colour_of_the_part(self):
        whole = self.look_along_y()
        unit = (whole["right"] - whole["left"]) / 0.2
        self.choose("Cut the bodies open", "y")
        self.panel("other half").click()
        self.assertAlmostEqual(self.seen()["count"] / whole["count"], 1, delta=0.01)
        for part, z, colour in (("low", 0.05, [0x6F, 0x9F, 0xD0]), ("high", 0.16, [0xD9, 0x9A, 0x6C])):
            pixel = self.driver.execute_script(PIXEL, self.canvas, whole["left"] + 0.05 * unit, whole["bottom"] - z * unit)
            self.assertEqual(pixel, [*colour, 255], part)
        self.panel("high").click()
        pixel = self.driver.execute_script(PIXEL, self.canvas, whole["left"] + 0.05 * unit, whole["bottom"] - 0.16 * unit)
        self.assertEqual(pixel[3], 0)

    def test_pictures_of_all_frames_and_a_movie_are_saved(self):
        last = self.driver.execute_script("return Number(document.querySelector('.time input').max)")
        self.go_to(3)
        name, data = saved(self.driver, self.panel("frames"))
        self.assertEqual(name, "frames.zip")
        archive = zipfile.ZipFile(io.BytesIO(data))
        self.assertIsNone(archive.testzip())
        self.assertEqual(archive.namelist(), [f"frame_{k:04d}.png" for k in range(last + 1)])
        self.assertEqual({archive.read(entry)[:8] for entry in archive.namelist()}, {b"\x89PNG\r\n\x1a\n"})
        self.assertEqual(self.frame(), 3)
        Select(self.driver.find_element(By.CSS_SELECTOR, ".time select")).select_by_visible_text("fast")
        name, data = saved(self.driver, self.panel("movie"))
        self.assertEqual((name, data[:4]), ("movie.webm", b"\x1a\x45\xdf\xa3"))  # EBML
        self.assertGreater(len(data), 10_000)
        name, data = saved(self.driver, self.panel("PNG"))
        self.assertEqual((name, data[:4]), ("view.png", b"\x89PNG"))

    def test_full_screen(self):
        before = self.driver.find_element(By.CSS_SELECTOR, ".stage").size["width"]
        self.panel("full screen").click()
        wait_for(self.driver, "document.fullscreenElement?.matches('.view')")
        wait_for(self.driver, "document.querySelector('.stage').clientWidth > arguments[0]", before)
        self.panel("full screen").click()
        wait_for(self.driver, "document.fullscreenElement === null")

    def test_deformation_is_scaled(self):
        self.go_to(self.driver.execute_script("return Number(document.querySelector('.time input').max)"))
        plain = self.look_along_y()
        scale = self.labelled("deformation")
        scale.clear()
        scale.send_keys("0", Keys.ENTER)
        flat = self.seen()
        self.assertNotEqual(flat["hash"], plain["hash"])
        self.assertAlmostEqual((flat["bottom"] - flat["top"]) / (flat["right"] - flat["left"]), 0.21 / 0.2, delta=0.02)

    def test_the_page_needs_nothing_else(self):
        text = self.page.read_text(encoding="utf-8")
        self.assertLess(len(text.encode()), 6_000_000)
        loaded = self.driver.execute_script("return performance.getEntriesByType('resource').map((e) => e.name)")
        self.assertEqual([name for name in loaded if not name.startswith(("data:", "blob:"))], [])


class ErodedCells(unittest.TestCase):
    """Cells that go vanish, with their edges, from the picture with WebGL and from that without."""

    def test_they_are_seen_only_before(self):
        with tempfile.TemporaryDirectory() as folder:
            case = pathlib.Path(folder) / "eroded.toml"
            case.write_text(ERODED, encoding="utf-8")
            results = pathlib.Path(folder) / "results"
            subprocess.run([CAROM, "run", case, "--out", results, "--quiet"], check=False)
            for webgl in (True, False):
                with self.subTest(webgl=webgl), browser(*SIZE, webgl=webgl) as driver:
                    open_report(driver, results / "report.html")
                    canvas = driver.find_element(By.CSS_SELECTOR, ".stage canvas")
                    driver.execute_script("carom.show(0)")
                    whole = picture(driver, canvas)
                    driver.execute_script("carom.show(0.02)")
                    left = picture(driver, canvas)
                    # Towards the eye at (1, -1.4, 0.8) look one face along x, and one along y and z of each of the
                    # cubes that are there. 3 % for the pixels of edges.
                    expected = (1.0 + 1.4 + 0.8) / (1.0 + 4 * 1.4 + 4 * 0.8)
                    self.assertAlmostEqual(left["count"] / whole["count"], expected, delta=0.03 * expected)
                    self.assertAlmostEqual(left["left"], whole["left"], delta=1)


class Symmetry(unittest.TestCase):
    """Halves that a plane of symmetry has left out are drawn where they are wanted."""

    def test_they_double_the_picture(self):
        with tempfile.TemporaryDirectory() as folder:
            case = pathlib.Path(folder) / "quarter.toml"
            case.write_text(QUARTER, encoding="utf-8")
            results = pathlib.Path(folder) / "results"
            subprocess.run([CAROM, "run", case, "--out", results, "--quiet"], check=False)
            with browser(*SIZE) as driver:
                open_report(driver, results / "report.html")
                button = {b.text: b for b in driver.find_elements(By.CSS_SELECTOR, ".panel button")}
                self.assertEqual([text for text in button if text.startswith("mirror")], ["mirror x", "mirror y"])
                button["wall"].click()
                button["y"].click()
                driver.execute_script("carom.show(0)")
                driver.find_element(By.XPATH, "//label[contains(., 'contact forces')]/input").click()
                canvas = driver.find_element(By.CSS_SELECTOR, ".stage canvas")
                shapes = []
                for name in ("mirror y", "mirror x"):
                    button[name].click()
                    box = picture(driver, canvas)
                    shapes.append((box["right"] - box["left"]) / (box["bottom"] - box["top"]))
                # Seen along y: 0.05 m wide and 0.1 m high, and twice as wide with the half beyond x = 0.
                self.assertAlmostEqual(shapes[0], 0.5, delta=0.01)
                self.assertAlmostEqual(shapes[1], 1.0, delta=0.02)


class OtherReaders(unittest.TestCase):
    """The same page on a small screen, in the dark, without WebGL."""

    @classmethod
    def setUpClass(cls):
        View.setUpClass()

    @classmethod
    def tearDownClass(cls):
        View.tearDownClass()

    def test_small_screens_are_not_wider(self):
        with browser(420, 900) as driver:
            open_report(driver, View.page)
            self.assertLessEqual(driver.execute_script("return document.documentElement.scrollWidth"), 420)
            self.assertGreater(picture(driver, driver.find_element(By.CSS_SELECTOR, ".stage canvas"))["count"], 1000)

    def test_dark(self):
        with browser(dark=True) as driver:
            open_report(driver, View.page)
            colour = driver.execute_script("return getComputedStyle(document.querySelector('.stage')).backgroundColor")
            self.assertLess(max(int(v) for v in colour.strip("rgb()").split(",")[:3]), 80)
            self.assertGreater(picture(driver, driver.find_element(By.CSS_SELECTOR, ".stage canvas"))["count"], 1000)

    def test_without_webgl_there_is_a_still_picture(self):
        with browser(webgl=False) as driver:
            open_report(driver, View.page)
            self.assertIn("no WebGL", driver.find_element(By.CSS_SELECTOR, ".missing").text)
            canvas = driver.find_element(By.CSS_SELECTOR, ".stage canvas")
            one = picture(driver, canvas)
            self.assertGreater(one["count"], 1000)
            driver.execute_script("carom.show(0)")
            self.assertNotEqual(picture(driver, canvas)["hash"], one["hash"])


if __name__ == "__main__":
    CAROM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
