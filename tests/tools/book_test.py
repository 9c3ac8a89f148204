"""Digits, kinds and sums of the verification book."""

import pathlib
import sys
import types
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
import book_tables  # noqa: E402


def check(value, reference, tolerance, kind="relative", source="exact", passed=True):
    return {"name": "A.velocity_z", "time": 1.0, "value": value, "reference": reference, "difference": value - reference,
            "tolerance": tolerance, "tolerance_kind": kind, "source": source, "pass": passed}


class Digits(unittest.TestCase):
    def test_a_value_ends_at_the_second_digit_of_what_it_may_be_off_by(self):
        self.assertEqual(book_tables.to_tolerance(123.456789, 0.5), "123.46")
        self.assertEqual(book_tables.to_tolerance(-0.00123456, 1e-5), "-0.001235")
        self.assertEqual(book_tables.to_tolerance(1 / 3, 1e-15), "0.333333333")

    def test_a_zero_has_one_digit(self):
        self.assertEqual(book_tables.to_tolerance(3.14159265358979e-17, 1e-9), "0")
        self.assertEqual(book_tables.to_tolerance(0.0, 1e-9), "0")

    def test_an_error_has_three(self):
        self.assertEqual(book_tables.error_text(check(1.00123456, 1.0, 0.01)), "0.123 %")
        self.assertEqual(book_tables.error_text(check(-1.5, -1.0, 0.01)), "-50 %")
        self.assertEqual(book_tables.error_text(check(3.14159265e-17, 0.0, 1e-9, "absolute")), "3.14e-17")

    def test_about_zero_it_is_as_it_is(self):
        """A component of 0.0011 that may be off by 0.001: percent of it say nothing."""
        self.assertEqual(book_tables.error_text(check(-0.0007, -0.0011, 0.001, "absolute")), "0.0004")
        self.assertEqual(book_tables.error_text(check(1.1, 1.0, 0.15, "absolute")), "10 %")

    def test_what_is_allowed_is_in_percent_or_as_it_is(self):
        self.assertEqual(book_tables.tolerance_text(check(1.0, 2.0, 0.015)), "1.5 %")
        self.assertEqual(book_tables.tolerance_text(check(1.0, 2.0, 0.015, "absolute")), "0.015")


class Kinds(unittest.TestCase):
    def test_sources_say_against_what_a_value_stands(self):
        for source, kind in {
                "Code_Aster manual V5.03.100, table of modelling A": "published values",
                "converged values of two published codes: length 21.42 mm": "published values",
                "Code_Aster, test sdnv100a of its validation base": "independent codes",
                "independent 1-D computation in SI, tests/verification/reference_1d, times powers of ten": "independent codes",
                "the bar in one piece, the same step": "other runs of Carom",
                "as surface_to_surface_penalty.toml; nodes on faces do not pass": "other runs of Carom",
                "balance of powers: 1e-10 of the initial 3200 J": "balances and symmetries",
                "exact by symmetry; 1e-5 of the impulse along z": "balances and symmetries",
                "Hertz: parted after 52.2422 us": "exact solutions",
                "v0 t": "exact solutions"}.items():
            self.assertEqual(book_tables.KINDS[book_tables.kind_of([source])][0], kind, source)

    def test_as_above_is_of_the_kind_above(self):
        sources = ["v0 t", "independent 1-D computation", "as above", "as above"]
        self.assertEqual(book_tables.KINDS[book_tables.kind_of(sources)][0], "independent codes")


class Sums(unittest.TestCase):
    def test_errors_are_summed_up_by_kind(self):
        """0.1, 0.3 and 2 percent: the median is 0.3; of the zeros the largest is half of what is allowed."""
        runs = [types.SimpleNamespace(name="a/b", summary={"checks": [check(1.001, 1.0, 0.1), check(1.02, 1.0, 0.1)]}),
                types.SimpleNamespace(name="c", summary={"checks": [check(0.997, 1.0, 0.1), check(5e-10, 0.0, 1e-9, "absolute")]}),
                types.SimpleNamespace(name="d", summary={"checks": [check(1.0, 1.0, 0.1, source="independent 1-D computation")]})]
        table = book_tables.summary_table(runs)
        self.assertIn('<td>exact solutions<br><span class="soft">closed forms, waves in one dimension, Hertz&#x27;s theory, what was imposed'
                      '</span></td><td class="number">4</td><td class="number">2</td><td class="number">4</td><td class="number">3</td>'
                      '<td class="number">0.3 %</td><td class="number">2 %<br><a href="#case-a-b">a/<wbr>b</a></td>'
                      '<td class="number">1</td><td class="number">50 %<br><a href="#case-c">c</a></td>', table)
        self.assertIn("<td>independent codes<br>", table)
        self.assertNotIn("published", table)

    def test_a_source_is_said_once(self):
        sources = []
        table = book_tables.check_table([check(1, 1, 1), check(1, 1, 1, source="other"), check(1, 1, 1)], sources)
        self.assertEqual(sources, ["exact", "other"])
        self.assertEqual([row.split("</td></tr>")[0][-1] for row in table.split("<tr>")[2:]], ["1", "2", "1"])

    def test_a_sentence_is_said_once(self):
        texts = [("one", "A bar hits. By penalty."), ("two", "A bar hits. By impulses."), ("three", "By penalty.")]
        self.assertEqual(book_tables.said_once(texts),
                         [("A bar hits. By penalty.", None), ("By impulses.", "one"), ("", "one")])


if __name__ == "__main__":
    unittest.main()
