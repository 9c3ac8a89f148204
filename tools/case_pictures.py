"""Pictures of runs, from their reports in a browser. Used by gallery.py and book.py."""

import concurrent.futures
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests/browser"))
from browser import browser, open_report  # noqa: E402

AROUND = 48  # pixels of the page beside the picture


def choose(driver, quantity, share):
    """What the view shows: a quantity, at a share of the time; fails where the run does not have it."""
    driver.execute_script("""
      const [quantity, share] = arguments, view = document.querySelector(".view");
      const select = view.querySelector("select"), option = [...select.options].find((o) => o.textContent === quantity);
      if (!option) throw new Error("no " + quantity + " among " + [...select.options].map((o) => o.textContent));
      select.value = option.value;
      select.dispatchEvent(new Event("change"));
      const slider = view.querySelector(".time input");
      slider.value = Math.round(share * slider.max);
      slider.dispatchEvent(new Event("input"));
    """, quantity, share)


def take(driver, report, path, height, what=None):
    """The view of a report as PNG, as it opens or, `what` = (quantity, share), as it is asked for; of a report without a
    view its first chart. False where there is neither."""
    open_report(driver, report)
    if what:
        choose(driver, *what)
    found = driver.execute_script("""
      const stage = document.querySelector(".stage"), chosen = stage || document.querySelector("figure");
      if (stage) stage.style.height = arguments[0] + "px";
      if (chosen) chosen.scrollIntoView();
      for (const buttons of document.querySelectorAll(".exports")) buttons.remove();
      return chosen;
    """, height)
    if found is None:
        return False
    driver.execute_async_script("requestAnimationFrame(() => requestAnimationFrame(arguments[0]))")
    found.screenshot(str(path))
    return True


def take_all(jobs, width, height):
    """Of (report, path, what) each, as many browsers at a time as there are cores; whether there is a picture of each."""
    shares = [jobs[k::os.cpu_count()] for k in range(os.cpu_count())]

    def take_some(some):
        if not some:
            return {}
        with browser(width + AROUND, 900) as driver:
            return {path: take(driver, report, path, height, what) for report, path, what in some}

    done = {}
    with concurrent.futures.ThreadPoolExecutor(len(shares)) as pool:
        for found in pool.map(take_some, shares):
            done.update(found)
    return [done[path] for _, path, _ in jobs]
