"""The manual in a browser: its search finds something, from a disk as well as from a server.

Usage: manual_test.py FOLDER, where tools/manual.py has made it.
"""

import functools
import http.server
import pathlib
import sys
import threading
import unittest

from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

from browser import browser


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


class Manual(unittest.TestCase):
    folder = pathlib.Path()

    def search(self, page):
        """What the search of a page finds for `restitution`; fails where the browser complains."""
        with browser(1400, 900) as driver:
            driver.get(page)
            field = driver.find_element(By.CSS_SELECTOR, ".md-search__input")
            field.click()
            field.send_keys("restitution")
            found = WebDriverWait(driver, 20).until(
                lambda d: [item.text for item in d.find_elements(By.CSS_SELECTOR, ".md-search-result__item")])
            complaints = [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
            self.assertEqual(complaints, [])
        return "\n".join(found)

    def test_from_a_disk(self):
        self.assertIn("Time schemes", self.search((self.folder / "index.html").as_uri()))

    def test_from_a_server(self):
        handler = functools.partial(Quiet, directory=self.folder)
        with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
            threading.Thread(target=server.serve_forever, daemon=True).start()
            self.assertIn("Time schemes", self.search(f"http://127.0.0.1:{server.server_port}/howto/friction.html"))
            server.shutdown()


if __name__ == "__main__":
    Manual.folder = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
