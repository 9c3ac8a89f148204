"""Fields and contact forces as arrays, now and at the instants that were kept; tables for pandas and xarray."""

import pickle
import subprocess
import sys
import unittest
from unittest import mock

import numpy as np

import carom
from python_fixture import FolderTest, falling_block, on_a_bed

E, NU = 2.1e11, 0.3
LAMBDA, G = E * NU / ((1 + NU) * (1 - 2 * NU)), E / (2 * (1 + NU))


def touching(scheme="central_differences"):
    """The run of the falling block while it touches the floor."""
    run = falling_block(scheme).start(threads=1)
    run.step(30)
    return run


def mean_gradients(run):
    """The mean over each brick of the gradient of the displacement: the difference of the means over opposite faces, over
    the edge between them (Gauss' theorem; the displacement is bilinear on a face, its mean that of the corners)."""
    corners = run.mesh.cells["hexa8"][run.cells.rows]
    x, u = run.mesh.points[corners], run.displacement[corners]
    gradient = np.empty((len(corners), 3, 3))
    for axis in range(3):
        upper = x[:, :, axis] > x[:, :, axis].mean(axis=1)[:, None]
        edge = np.ptp(x[:, :, axis], axis=1)
        means = [np.where(side[:, :, None], u, 0.0).sum(axis=1) / 4 for side in (upper, ~upper)]
        gradient[:, :, axis] = (means[0] - means[1]) / edge[:, None]
    return gradient


class FieldTest(FolderTest):
    def test_stress_is_hookes_law_of_the_mean_strain(self):
        run = touching()
        gradient = mean_gradients(run)
        strain = (gradient + gradient.transpose(0, 2, 1)) / 2
        tensor = LAMBDA * np.trace(strain, axis1=1, axis2=2)[:, None, None] * np.eye(3) + 2 * G * strain
        expected = tensor[:, [0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0]]
        self.assertGreater(np.abs(expected[:, 2]).max(), 1e7)  # a wave of 5 m/s has rho c v = 2e8
        np.testing.assert_allclose(run.stress, expected, rtol=0, atol=1e-9 * np.abs(expected).max())
        deviator = tensor - np.trace(tensor, axis1=1, axis2=2)[:, None, None] / 3 * np.eye(3)
        mises = np.sqrt(1.5 * (deviator**2).sum(axis=(1, 2)))
        np.testing.assert_allclose(run.field("von_mises"), mises, rtol=0, atol=1e-9 * mises.max())
        principal = np.linalg.eigvalsh(tensor)[:, ::-1]
        np.testing.assert_allclose(run.field("principal_stress"), principal, rtol=0, atol=1e-8 * mises.max())

    def test_fields_of_nodes_are_the_state(self):
        run = touching()
        for name in ("displacement", "velocity", "acceleration"):
            np.testing.assert_array_equal(run.field(name), getattr(run, name))

    def test_shapes_units_and_components_are_those_of_the_table(self):
        run = touching()
        rows = {"nodes": len(run.mesh.points), "cells": len(run.cells.numbers)}
        self.assertIn("von_mises", run.fields)
        for name, kind in run.fields.items():
            shape = (rows[kind.place], *((len(kind.components),) if kind.components else ()))
            self.assertEqual(run.field(name).shape, shape, name)
        stress = run.fields["stress"]
        self.assertEqual((stress.unit, stress.components), ("Pa", ("xx", "yy", "zz", "xy", "yz", "zx")))
        self.assertEqual(run.fields["velocity"].unit, "m/s")
        self.assertEqual(run.fields["principal_stress"].components, ("1", "2", "3"))

    def test_rows_of_several_parts_are_part_by_part(self):
        case = falling_block()
        case["mesh"]["block"].append({"origin": [0.2, 0.0, 5e-5], "size": [0.1, 0.1, 0.1], "divisions": [1, 2, 1],
                                      "groups": {"cells": "SECOND"}})
        case["part"].insert(0, {"name": "second", "cells": "SECOND", "material": "steel"})
        run = case.start()
        cells = run.cells
        self.assertEqual(list(cells.parts), [0] * 2 + [1] * 128)
        self.assertEqual(set(cells.types), {"hexa8"})
        x = run.mesh.points[run.mesh.cells["hexa8"][cells.rows]].mean(axis=1)[:, 0]
        np.testing.assert_array_equal(x > 0.15, cells.parts == 0)
        self.assertEqual(sorted(cells.numbers), sorted(set(cells.numbers)))

    def test_history_of_a_law_is_a_field(self):
        case = falling_block(speed=-50.0)
        case["materials"]["steel"] = {"law": "j2", "E": E, "nu": NU, "rho": 7800.0, "yield_stress": 1e8,
                                      "hardening_modulus": 1e9}
        run = case.start()
        run.step(30)
        strain = run.field("equivalent_plastic_strain")
        self.assertEqual(strain.shape, (128,))
        self.assertGreater(strain.max(), 1e-5)
        self.assertEqual(run.fields["equivalent_plastic_strain"].place, "cells")

    def test_unknown_names_list_those_there_are(self):
        run = touching()
        with self.assertRaisesRegex(KeyError, "stres'.*von_mises"):
            run.field("stres")
        with self.assertRaisesRegex(KeyError, "contact_slip wants to be in output.fields"):
            run.field("contact_slip")
        with self.assertRaisesRegex(KeyError, "'wall'.*floor"):
            run.contact_force("wall")
        with self.assertRaisesRegex(KeyError, "speed"):
            run.record(["speed"])
        with self.assertRaisesRegex(KeyError, "displacement"):
            run.record(["displacement"])["velocity"]
        case = falling_block()
        case["output"]["fields"] = ["contact_slip"]
        self.assertEqual(case.start().field("contact_slip").shape, (len(run.mesh.points),))


class ContactForceTest(FolderTest):
    def test_penalty_at_nodes(self):
        # Of every node stiffness times its share of the area times its depth: the law of docs/case_format.md.
        run = touching()
        found = run.contact_force("floor")
        foot = run.mesh.nodes_of("FOOT")
        np.testing.assert_array_equal(found.nodes, np.intersect1d(found.nodes, foot))
        depth = -(run.mesh.points + run.displacement)[found.nodes, 2]
        x, y = run.mesh.points[found.nodes, :2].T
        edges = [np.where((c < 1e-9) | (c > 0.1 - 1e-9), 0.5, 1.0) for c in (x, y)]
        expected = 1e13 * edges[0] * edges[1] * 0.025**2 * depth
        self.assertGreater(len(found.nodes), 20)
        np.testing.assert_allclose(found.force[:, 2], expected, rtol=1e-9)
        np.testing.assert_array_equal(found.force[:, :2], 0.0)
        np.testing.assert_allclose(found.force.sum(axis=0), run.contact["floor"].force, rtol=1e-12, atol=1e-3)
        np.testing.assert_array_equal(found.numbers, run.node_numbers[found.nodes])

    def assert_balanced(self, run, name):
        """Action and reaction; and on the nodes of the group what contact.csv says."""
        found, force = run.contact_force(name), run.contact[name].force
        self.assertGreater(abs(force[2]), 1e4)
        np.testing.assert_allclose(found.force.sum(axis=0), 0.0, atol=1e-9 * abs(force[2]))
        own = np.isin(found.nodes, run.mesh.nodes_of("FOOT"))
        self.assertTrue(own.any() and not own.all())
        np.testing.assert_allclose(found.force[own].sum(axis=0), force, atol=1e-9 * abs(force[2]))

    def test_action_and_reaction_of_two_bodies(self):
        for scheme, method in (("central_differences", "node_to_surface"), ("central_differences", "two_pass"),
                               ("central_differences", "faces"), ("cd_lagrange", "two_pass"), ("newmark", "two_pass")):
            with self.subTest(scheme=scheme, method=method):
                case = on_a_bed(falling_block(scheme))
                case["contact"] = [{"name": "touch", "kind": "pair", "group": "FOOT", "master": "HEAD", "method": method,
                                    "friction": 0.3}]
                run = case.start()
                while run.time < 3e-5:
                    run.step()
                self.assert_balanced(run, "touch")

    def test_ties_that_tear(self):
        case = on_a_bed(falling_block(), gap=0.0)
        case["contact"] = [{"name": "glue", "kind": "tie", "group": "FOOT", "master": "HEAD", "normal_strength": 1e9,
                            "shear_strength": 1e9, "normal_fracture_energy": 1e5, "shear_fracture_energy": 1e5}]
        case["initial"][0]["velocity"] = [0.0, 1.0, 5.0]
        run = case.start()
        while run.time < 1e-5:
            run.step()
        self.assert_balanced(run, "glue")

    def test_open_contact_has_none(self):
        found = falling_block().start().contact_force("floor")
        self.assertEqual((found.nodes.shape, found.force.shape), ((0,), (0, 3)))


class FramesTest(FolderTest):
    names = ["displacement", "stress", "contact_status", "von_mises"]

    def both(self, **output):
        """The same run's frames in memory and in its folder."""
        case = falling_block()
        case["output"] = {"fields": self.names, "fields_every": 10, **output}
        run = case.start("out")
        kept = run.record(self.names, every=10)
        run.finish()
        return kept, carom.read_frames("out")

    def test_folder_and_memory_hold_the_same(self):
        for output in ({"precision": "double"}, {"precision": "double", "format": "vtu"}):
            kept, read = self.both(**output)
            self.assertGreater(len(kept.time), 4)
            np.testing.assert_allclose(read.time, kept.time, rtol=1e-12)
            for name in self.names:
                self.assertEqual(read.kinds[name], kept.kinds[name])
                np.testing.assert_array_equal(read[name], kept[name], name)
                np.testing.assert_array_equal(read.at(name, -1), kept[name][-1], name)
            np.testing.assert_array_equal(read.node_numbers, kept.node_numbers)
            np.testing.assert_array_equal(read.mesh.points, kept.mesh.points)
            for one in ("numbers", "parts", "types"):
                np.testing.assert_array_equal(getattr(read.cells, one), getattr(kept.cells, one))
            corners = [f.mesh.cells["hexa8"][f.cells.rows] for f in (read, kept)]
            np.testing.assert_array_equal(*corners)

    def test_single_precision_is_that_of_the_files(self):
        kept, read = self.both()
        self.assertEqual(read["stress"].dtype, np.float32)
        np.testing.assert_array_equal(read["stress"], kept["stress"].astype(np.float32))

    def test_nodes_of_obstacles_are_left_out(self):
        case = falling_block()
        case["contact"][0]["velocity"] = [0.0, 0.0, 1.0]
        run = case.start("out")
        self.assertGreater(len(run._mesh().points), len(run.displacement))
        run.finish()
        self.assertEqual(len(carom.read_frames("out")["displacement"][0]), len(run.displacement))

    def test_frames_that_are_taken_back_go(self):
        run = falling_block().start()
        kept = run.record(["velocity"], every=5)
        run.step(10)
        snapshot = run.save()
        run.step(10)
        run.restore(snapshot)
        self.assertEqual(len(kept.time), 5)
        run.step(5)
        self.assertEqual(len(kept.time), 4)
        np.testing.assert_array_equal(np.diff(kept.time) > 0.0, True)
        self.assertEqual(len(pickle.loads(pickle.dumps(kept)).time), 4)

    def test_places_without_frames(self):
        with self.assertRaisesRegex(FileNotFoundError, "output.fields"):
            carom.read_frames("nowhere")
        kept, _ = self.both()
        with self.assertRaisesRegex(KeyError, "'speed'.*von_mises"):
            kept["speed"]
        with self.assertRaisesRegex(IndexError, "frame 100 of"):
            kept.at("stress", 100)


class PandasTest(FolderTest):
    def test_curves(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("pandas is not installed (apt install python3-pandas)")
        result = falling_block().start().finish()
        for curves in (result.energy, result.history):
            frame = curves.to_pandas()
            self.assertEqual(list(frame.columns), [name for name in curves if name != "time"])
            np.testing.assert_array_equal(frame.index, curves["time"])
            self.assertEqual(frame.index.name, "time")
            for name in frame.columns:
                np.testing.assert_array_equal(frame[name], curves[name])
        self.assertEqual(frame.attrs["units"]["floor.force_z"], "N")
        self.assertEqual(frame.attrs["units"]["floor.closed"], "")
        frame.iloc[0] = -1.0
        self.assertNotEqual(result.history["floor.force_z"][0], -1.0)

    def test_what_to_install(self):
        result = falling_block().start().finish()
        with mock.patch.dict(sys.modules, {"pandas": None}):
            with self.assertRaisesRegex(ImportError, "apt install python3-pandas"):
                result.energy.to_pandas()


class XarrayTest(FolderTest):
    def test_fields(self):
        try:
            import xarray  # noqa: F401
        except ImportError:
            self.skipTest("xarray is not installed (apt install python3-xarray)")
        run = falling_block().start()
        kept = run.record(["velocity", "stress", "principal_stress", "von_mises"], every=20)
        run.finish()
        data = kept.to_xarray()
        self.assertEqual(data.stress.dims, ("time", "cell", "component"))
        self.assertEqual(data.velocity.dims, ("time", "node", "axis"))
        self.assertEqual(data.von_mises.dims, ("time", "cell"))
        self.assertEqual(data.stress.attrs["units"], "Pa")
        number = int(kept.cells.numbers[7])
        np.testing.assert_array_equal(data.stress.sel(cell=number, component="zz"), kept["stress"][:, 7, 2])
        np.testing.assert_array_equal(data.principal_stress.sel(principal="3").isel(time=-1),
                                      kept["principal_stress"][-1, :, 2])
        top = data.velocity.where(data.z > 0.2, drop=True)
        self.assertEqual(top.sizes["node"], 25)
        self.assertEqual(set(kept.to_xarray(["von_mises"]).data_vars), {"von_mises"})

    def test_what_to_install(self):
        kept = falling_block().start().record(["velocity"])
        with mock.patch.dict(sys.modules, {"xarray": None}):
            with self.assertRaisesRegex(ImportError, "apt install python3-xarray"):
                kept.to_xarray()

    def test_neither_is_loaded_unasked(self):
        code = "import sys, carom; print({'pandas', 'xarray'} & set(sys.modules))"
        self.assertEqual(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                                        check=True).stdout.strip(), "set()")


if __name__ == "__main__":
    unittest.main()
