"""Laws of friction and of contact that are Python's: closed forms, books, and what they are refused with."""

import os
import pathlib
import subprocess
import unittest

import numpy as np

import carom
from python_fixture import PROGRAM, FolderTest, falling_block, on_a_bed

CASES = pathlib.Path(os.environ["CAROM_SOURCE"]) / "cases"
SCHEMES = ("penalty", "newmark", "cd_lagrange", "moreau_jean", "nonsmooth_generalized_alpha")
G, SPEED = 9.81, 2.0


def sliding(scheme):
    """The block of cases/friction, which slides on a plane with a velocity of 2 m/s at the start."""
    case = carom.load(CASES / f"friction/block_{scheme}.toml")
    for key in ("exact", "check"):
        case._tree.pop(key, None)
    case["output"] = {"fields": []}
    return case


def speed(result):
    return result.history["block.velocity_x"]


class FrictionTest(FolderTest):
    def test_a_constant_law_is_the_constant(self):
        for scheme in SCHEMES:
            with self.subTest(scheme=scheme):
                one, other = sliding(scheme), sliding(scheme)
                mu = one["contact"][0]["friction"]
                other.friction_law("ground", lambda pressure, rate, place, time: mu)
                np.testing.assert_allclose(speed(other.start().finish()), speed(one.start().finish()), rtol=0,
                                           atol=1e-9 * SPEED)

    def test_of_deformable_bodies_too(self):
        for scheme, method in (("central_differences", "node_to_surface"), ("central_differences", "faces"),
                               ("newmark", "two_pass"), ("hht", "faces"), ("cd_lagrange", "two_pass")):
            with self.subTest(scheme=scheme, method=method):
                force = []
                for law in (0.3, lambda pressure, rate, place, time: np.full(len(pressure), 0.3)):
                    case = on_a_bed(falling_block(scheme))
                    case["initial"][0]["velocity"] = [2.0, 0.0, -5.0]
                    case["contact"] = [{"name": "touch", "kind": "pair", "group": "FOOT", "master": "HEAD",
                                        "method": method}]
                    if callable(law):
                        case.friction_law("touch", law)
                    else:
                        case["contact"][0]["friction"] = law
                    force.append(case.start().finish().history["touch.force_x"])
                self.assertGreater(np.abs(force[0]).max(), 1e4)
                np.testing.assert_allclose(force[1], force[0], rtol=0, atol=1e-6 * np.abs(force[0]).max())

    def test_coefficient_that_grows_with_the_slip_rate(self):
        # dv/dt = -(a + b v) g: v = (v_0 + a / b) exp(-b g t) - a / b until it stops. The coefficient is one step old:
        # an error of the first order, a few steps' share of what it changes.
        a, b = 0.1, 0.1
        for scheme in SCHEMES:
            with self.subTest(scheme=scheme):
                case = sliding(scheme)
                case.friction_law("ground", lambda pressure, rate, place, time: a + b * rate)
                result = case.start().finish()
                time = result.history["time"]
                exact = np.maximum(0.0, (SPEED + a / b) * np.exp(-b * G * time) - a / b)
                self.assertLess(np.abs(speed(result) - exact).max(), 0.02 * SPEED)
                spent = result.energy["friction"][-1] / result.energy["kinetic"][0]
                self.assertAlmostEqual(spent, 1.0 - (speed(result)[-1] / SPEED)**2, delta=0.02)
                self.assertLess(np.abs(result.energy["imbalance"]).max(), 1e-9 * result.energy["kinetic"][0])

    def test_coefficient_of_place_and_time(self):
        # Ice up to x = 0.3, then a coefficient that grows with the time. The block has nodes at x = 0 and 0.2.
        def mu(pressure, rate, place, time):
            return np.where(place[:, 0] < 0.3, 0.0, 0.2 + time)

        case = sliding("newmark")
        case.friction_law("ground", mu)
        result = case.start().finish()
        time, v = result.history["time"], speed(result)
        x = result.history["block.displacement_x"]
        on_ice = x < 0.099
        np.testing.assert_allclose(v[on_ice], SPEED, atol=1e-9)
        off = x > 0.301  # both nodes have left it
        i, j = np.flatnonzero(off & (v > 0.2))[[0, -1]]
        fallen = G * (0.2 * (time[j] - time[i]) + (time[j]**2 - time[i]**2) / 2)
        self.assertAlmostEqual(v[i] - v[j], fallen, delta=0.02 * fallen)

    def test_what_the_law_sees(self):
        seen = []

        def mu(pressure, rate, place, time):
            seen.append((pressure, rate, place, time))
            return np.full(len(pressure), 0.3)

        case = falling_block()
        case["initial"][0]["velocity"] = [1.0, 0.0, -5.0]
        case.friction_law("floor", mu)
        run = case.start()
        while not run.contact["floor"].closed:
            run.step()
        run.step(5)
        force, time = run.contact_force("floor"), run.time
        pressure = run.field("contact_pressure")[force.nodes]
        slip = run.field("contact_slip_rate")[force.nodes]
        seen.clear()
        run.step()
        got_pressure, got_rate, place, at = seen[-1]
        self.assertEqual(at, time)
        self.assertEqual((place.shape[1], got_pressure.shape), (3, got_rate.shape))
        np.testing.assert_allclose(np.sort(got_pressure)[-len(pressure):], np.sort(pressure), rtol=1e-12)
        np.testing.assert_allclose(np.sort(got_rate)[-len(slip):], np.sort(slip), rtol=1e-9)

    def test_pressure_decides(self):
        # tau = c below and above: mu = c / p gives a shear stress that does not depend on the pressure.
        c = 1e6
        case = falling_block()
        case["initial"][0]["velocity"] = [2.0, 0.0, -5.0]
        case.friction_law("floor", lambda pressure, rate, place, time: c / np.maximum(pressure, 1e5))
        run = case.start()
        while run.time < 5e-5:
            run.step()
        found = run.contact_force("floor")
        inside = np.ptp(run.mesh.points[found.nodes][:, :2] - 0.05, axis=1) >= 0
        sizes = np.hypot(found.force[:, 0], found.force[:, 1])
        area = found.force[:, 2] / run.field("contact_pressure")[found.nodes]
        sliding_ones = run.field("contact_status")[found.nodes] == 3
        self.assertGreater(sliding_ones.sum(), 5)
        np.testing.assert_allclose((sizes / area)[sliding_ones & inside], c, rtol=0.2)  # pressures change in a step
        self.assertLess(np.abs(run.energy["imbalance"]).max(), 1e-10 * run.energy["kinetic"][0])

    def test_snapshots_bring_the_same_bits(self):
        case = sliding("newmark")
        case.friction_law("ground", lambda pressure, rate, place, time: 0.1 + 0.1 * rate)
        whole = case.start().finish()
        run = case.start()
        run.step(20)
        snapshot = run.save()
        run.step(20)
        other = case.start()
        other.restore(snapshot)
        np.testing.assert_array_equal(speed(other.finish()), speed(whole))
        run.restore(snapshot)
        np.testing.assert_array_equal(speed(run.finish()), speed(whole))

    def test_what_it_raises_comes_out_and_the_run_goes_on(self):
        bad = {"answer": None}

        def mu(pressure, rate, place, time):
            if bad["answer"] is None:
                raise ZeroDivisionError("no friction today")
            return bad["answer"](len(pressure))

        case = sliding("penalty")
        case.friction_law("ground", mu)
        with self.assertRaises(ZeroDivisionError):
            case.start().step()
        for answer, error, text in ((lambda n: np.full(n, -0.1), ValueError, "numbers >= 0"),
                                    (lambda n: np.full(n, np.nan), ValueError, "nan"),
                                    (lambda n: np.ones(n + 1), ValueError, "3 numbers for 2 rows"),
                                    (lambda n: "much", TypeError, "no array of numbers")):
            bad["answer"] = answer
            with self.assertRaisesRegex(error, text):
                case.start().step()

    def test_it_is_not_in_the_folder(self):
        case = sliding("newmark")
        case.friction_law("ground", lambda pressure, rate, place, time: 0.3)
        run = case.start("out")
        run.step(3)
        run.stop()
        with self.assertRaisesRegex(carom.CaseError, "law of friction that a program computes"):
            carom.resume("out")
        told = subprocess.run([PROGRAM, "check", "out/case.resolved.toml"], capture_output=True, text=True, check=False)
        self.assertEqual(told.returncode, 2)
        self.assertIn("friction_law", told.stderr)
        with self.assertRaisesRegex(ValueError, "ground"):
            carom.compare(case, scheme="newmark")
        self.assertTrue(case.check().text)

    def test_refusals(self):
        case = sliding("newmark")
        with self.assertRaisesRegex(KeyError, "'floor'.*ground"):
            case.friction_law("floor", lambda *of: 0.3)
        with self.assertRaises(TypeError):
            case.friction_law("ground", 0.3)
        case.friction_law("ground", lambda *of: 0.3)
        case["contact"][0]["friction"] = 0.2
        with self.assertRaisesRegex(carom.CaseError, "one of the two"):
            case.check()
        del case["contact"][0]["friction"]
        case["erosion"] = [{"part": "block", "plastic_strain": 0.05}]
        with self.assertRaisesRegex(carom.CaseError, "friction_law.*erosion"):
            case.check()


def falling_mass(scheme="central_differences", speed=1.0):
    """A stiff cube of 1 kg that falls without gravity on a soft law: a point mass on its spring."""
    tree = {"title": "mass", "units": "SI",
            "mesh": {"block": [{"origin": [0.0, 0.0, 0.0], "size": [0.1, 0.1, 0.1], "divisions": [1, 1, 1],
                                "groups": {"cells": "CUBE", "zmin": "FOOT"}}]},
            "materials": {"stiff": {"law": "linear_elastic", "E": 1e10, "nu": 0.0, "rho": 1000.0}},
            "part": [{"name": "cube", "cells": "CUBE", "material": "stiff"}],
            "initial": [{"part": "cube", "velocity": [0.0, 0.0, -speed]}],
            "contact": [{"name": "floor", "kind": "plane", "group": "FOOT", "point": [0.0, 0.0, 0.0],
                         "normal": [0.0, 0.0, 1.0], "measure": "area"}],
            "scheme": {"kind": scheme}, "time": {"end": 0.06},
            "output": {"fields": []},
            "probe": [{"name": "foot", "group": "FOOT", "quantities": ["displacement", "velocity"]}]}
    if scheme != "central_differences":
        tree["time"]["step"] = 5e-5
    return carom.Case(tree)


class ContactLawTest(FolderTest):
    area, mass = 0.01, 1.0

    def test_a_linear_law_is_the_stiffness(self):
        for scheme in ("central_differences", "newmark"):
            one, other = falling_block(scheme), falling_block(scheme)
            for case in (one, other):
                case["contact"][0]["friction"] = 0.3
            other.contact_law("floor", lambda depth: 1.0e13 * depth, depth=1e-4)
            np.testing.assert_allclose(other.start().finish().history["floor.force_z"],
                                       one.start().finish().history["floor.force_z"], rtol=0, atol=1e-3)

    def test_hertz(self):
        # m v^2 / 2 = A k d^2.5 / 2.5 at the deepest; contact lasts 2.9432 d / v (Johnson, Contact Mechanics, 1985, eq.
        # 11.24, of a force that grows with the power 1.5 of the depth); it leaves as fast as it came.
        k, v = 1e8, 1.0
        deepest = (1.25 * self.mass * v**2 / (self.area * k))**0.4
        for scheme in ("central_differences", "newmark", "hht"):
            with self.subTest(scheme=scheme):
                case = falling_mass(scheme, v)
                case.contact_law("floor", lambda depth: k * depth**1.5, depth=2 * deepest, tolerance=1e-5)
                result = case.start().finish()
                self.assertEqual(result.verdict, "good", result._repr_html_())
                history, energy = result.history, result.energy
                self.assertAlmostEqual(history["floor.penetration"].max(), deepest, delta=2e-3 * deepest)
                self.assertAlmostEqual(energy["contact_stored"].max(), self.mass * v**2 / 2, delta=4e-3)
                self.assertAlmostEqual(history["floor.impulse_z"][-1], 2 * self.mass * v, delta=4e-3)
                closed = history["time"][history["floor.closed"] > 0]
                self.assertAlmostEqual(closed[-1] - closed[0], 2.9432 * deepest / v, delta=1e-4)  # two steps
                self.assertLess(np.abs(energy["imbalance"]).max(), 1e-10 * energy["kinetic"][0])

    def test_stored_energy_is_the_integral_of_the_table(self):
        case = falling_mass()
        case["contact"][0].update(depths=[1e-3, 2e-3, 1e-2], pressures=[1e4, 3e4, 2e5])
        result = case.start().finish()
        d = result.history["floor.penetration"]
        self.assertGreater(d.max(), 2e-3)
        x = np.concatenate([[0.0], case["contact"][0]["depths"]])
        p = np.concatenate([[0.0], case["contact"][0]["pressures"]])
        fine = np.linspace(0.0, d.max(), 200_001)
        integral = np.concatenate([[0.0], np.cumsum(np.interp(fine, x, p)[:-1] + np.diff(np.interp(fine, x, p)) / 2)
                                   * (fine[1] - fine[0])])
        np.testing.assert_allclose(result.energy["contact_stored"], self.area * np.interp(d, fine, integral), rtol=0,
                                   atol=1e-6)
        np.testing.assert_allclose(result.history["floor.force_z"], self.area * np.interp(d, x, p), rtol=0, atol=1e-6)

    def test_equilibrium_on_a_table(self):
        # Weight 1 kg x 1e3 m/s^2 on 0.01 m^2: 1e5 Pa, which the last piece of the table has at 2e-3 + 7e4 / 2.125e7.
        case = falling_mass("statics", speed=0.0)
        del case["initial"]
        case["contact"][0].update(depths=[1e-3, 2e-3, 1e-2], pressures=[1e4, 3e4, 2e5])
        case["scheme"]["enforcement"] = "penalty"
        case["time"] = {"end": 1.0, "step": 0.25}
        case["load"] = [{"gravity": [0.0, 0.0, -1e3], "function": "ramp"}]
        case["functions"] = {"ramp": {"time": [0.0, 1.0], "value": [0.0, 1.0]}}
        case["support"] = [{"nodes": "all", "blocked": ["x", "y"]}]
        result = case.start().finish()
        self.assertAlmostEqual(result.history["floor.penetration"][-1], 2e-3 + 7e4 / 2.125e7, delta=1e-9)

    def test_it_is_in_the_case(self):
        case = falling_mass()
        case.contact_law("floor", lambda depth: 1e8 * depth**1.5, depth=1e-2)
        whole = case.start().finish()
        folder = self.command_line(case, "cli", "--threads", "1")
        np.testing.assert_array_equal(carom.read_results(folder).history["floor.force_z"], whole.history["floor.force_z"])
        run = case.start("out")
        run.until(0.02)
        run.stop()
        np.testing.assert_array_equal(carom.resume("out").finish().history["floor.force_z"],
                                      whole.history["floor.force_z"])

    def test_schemes_and_enforcements_that_ask_for_no_pressure(self):
        for scheme, enforcement in (("cd_lagrange", None), ("newmark", "lagrange"), ("newmark", "augmented_lagrangian"),
                                    ("energy_momentum", "penalty"), ("modified_mass", None)):
            case = falling_mass(scheme)
            if enforcement:
                case["scheme"]["enforcement"] = enforcement
            case.contact_law("floor", lambda depth: 1e8 * depth, depth=1e-2)
            with self.assertRaises(carom.CaseError, msg=(scheme, enforcement)) as caught:
                case.check()
            self.assertIn("contact[0].pressures", str(caught.exception))
        case = falling_mass()
        case["contact"][0] = {"name": "all", "kind": "all", "depths": [1.0], "pressures": [1.0]}
        with self.assertRaisesRegex(carom.CaseError, "depths"):
            case.check()

    def test_laws_that_are_none(self):
        case = falling_mass()
        for law, text in ((lambda d: 1.0 + d, "touch"), (lambda d: d * (0.015 - d), "not falling"),
                          (lambda d: np.where(d > 1e-3, 1.0, 0.0) + d, "jumps"), (lambda d: d * np.nan, "finite"),
                          (lambda d: 1.0, "one finite number")):
            with self.assertRaisesRegex(ValueError, text):
                case.contact_law("floor", law, depth=1e-2)
        with self.assertRaisesRegex(ValueError, "depth"):
            case.contact_law("floor", lambda d: d, depth=0.0)
        with self.assertRaisesRegex(KeyError, "floor"):
            case.contact_law("wall", lambda d: d, depth=1.0)
        for wrong, text in (({"depths": [1.0], "pressures": [1.0, 2.0]}, "1 depths and 2 pressures"),
                            ({"depths": [1.0, 0.5], "pressures": [1.0, 2.0]}, "0.5 at position 2"),
                            ({"depths": [1.0, 2.0], "pressures": [1.0, 0.5]}, "0.5 at position 2"),
                            ({"depths": [1.0], "pressures": [1.0], "stiffness": 1.0}, "beside a stiffness"),
                            ({"depths": [1.0], "pressures": [1.0], "stiffness_factor": 2.0}, "stiffness_factor"),
                            ({"pressures": [1.0]}, "0 depths")):
            wrong_case = falling_mass()
            wrong_case["contact"][0].update(wrong)
            with self.assertRaisesRegex(carom.CaseError, text):
                wrong_case.check()


if __name__ == "__main__":
    unittest.main()
