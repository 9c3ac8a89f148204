"""What the package promises beside its numbers: docstrings, types, quiet imports, tutorial scripts."""

import ast
import contextlib
import inspect
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import carom
from carom import _carom
from python_fixture import FolderTest

PACKAGE = pathlib.Path(carom.__file__).parent
EXAMPLES = pathlib.Path(os.environ["CAROM_SOURCE"]) / "examples/python"


def public_members(cls):
    """Public methods, properties and operators that a class defines itself."""
    for name, member in vars(cls).items():
        wanted = not name.startswith("_") or name in ("__init__", "__getitem__", "__iter__", "__len__", "__contains__")
        if wanted and (inspect.isroutine(member) or isinstance(member, (property, classmethod, staticmethod))):
            yield name, member


def docstring(member):
    return inspect.getdoc(member.fget if isinstance(member, property) and member.fget else member)


class DocumentationTest(unittest.TestCase):
    def test_every_public_name_has_a_docstring(self):
        for name in carom.__all__:
            found = getattr(carom, name)
            self.assertTrue(inspect.getdoc(found), name)
            for cls in (c for c in getattr(found, "__mro__", ()) if c.__module__.startswith("carom")):
                for member, value in public_members(cls):
                    if cls in (_carom.RunBase, _carom.Snapshot) and member == "__init__":
                        continue  # not for users
                    if issubclass(cls, tuple) or "__dataclass_fields__" in vars(cls) and member == "__init__":
                        continue
                    self.assertTrue(docstring(value), f"{cls.__name__}.{member}")

    def test_every_public_name_of_a_module_is_exported(self):
        for module in (path.stem for path in PACKAGE.glob("[a-z]*.py")):
            tree = ast.parse((PACKAGE / f"{module}.py").read_text())
            for node in tree.body:
                if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and not node.name.startswith("_"):
                    if node.name != "contact_states":
                        self.assertIn(node.name, carom.__all__, module)

    def test_attributes_of_results_and_errors_are_documented(self):
        for module in (path.stem for path in PACKAGE.glob("[a-z]*.py")):
            tree = ast.parse((PACKAGE / f"{module}.py").read_text())
            for cls in (n for n in tree.body if isinstance(n, ast.ClassDef) and n.name[0] != "_"):
                for one, following in zip(cls.body, cls.body[1:] + [None]):
                    if isinstance(one, ast.AnnAssign):
                        is_text = isinstance(following, ast.Expr) and isinstance(following.value, ast.Constant)
                        self.assertTrue(is_text, f"{cls.name}.{one.target.id}")


class TypesTest(unittest.TestCase):
    def test_package_is_marked_as_typed(self):
        self.assertTrue((PACKAGE / "py.typed").exists())

    def test_every_function_is_annotated(self):
        for path in PACKAGE.glob("*.py"):
            for node in ast.walk(ast.parse(path.read_text())):
                if isinstance(node, ast.FunctionDef):
                    where = f"{path.name}: {node.name}"
                    self.assertIsNotNone(node.returns, where)
                    arguments = node.args.args + node.args.kwonlyargs
                    for argument in arguments:
                        if argument.arg not in ("self", "cls"):
                            self.assertIsNotNone(argument.annotation, f"{where}({argument.arg})")

    def test_stub_and_extension_agree(self):
        tree = ast.parse((PACKAGE / "_carom.pyi").read_text())
        stub = {n.name: n for n in tree.body if isinstance(n, (ast.ClassDef, ast.FunctionDef))}
        own = {name for name, value in vars(_carom).items() if not name.startswith("_")}
        self.assertEqual(own, set(stub))
        for name, node in stub.items():
            if not isinstance(node, ast.ClassDef):
                continue
            in_stub = {n.name for n in node.body if isinstance(n, ast.FunctionDef)} - {"__init__"}
            hidden = ("__", "_pybind11")
            members = {m for m in vars(getattr(_carom, name)) if not m.startswith(hidden)}
            self.assertEqual(members, in_stub, name)

    def test_signatures_agree_with_the_stub(self):
        tree = ast.parse((PACKAGE / "_carom.pyi").read_text())
        for cls in (n for n in tree.body if isinstance(n, ast.ClassDef)):
            for method in (n for n in cls.body if isinstance(n, ast.FunctionDef) and n.name != "__init__"):
                if any(isinstance(d, ast.Name) and d.id == "property" for d in method.decorator_list):
                    continue
                said = getattr(getattr(_carom, cls.name), method.name).__doc__.splitlines()[0]
                for argument in method.args.args[1:]:
                    self.assertIn(f"{argument.arg}:", said, f"{cls.name}.{method.name}")


def python(*arguments, **environment):
    return subprocess.run([sys.executable, *arguments], capture_output=True, text=True, check=False,
                          env={**os.environ, **environment})


class ProcessTest(unittest.TestCase):
    def test_import_leaves_the_process_as_it_was(self):
        code = ("import os, signal, threading; before = dict(os.environ), [signal.getsignal(s) for s in range(1, 32)]; "
                "import carom; assert before == (dict(os.environ), [signal.getsignal(s) for s in range(1, 32)]); "
                "print(threading.active_count())")
        answer = python("-W", "error", "-c", code)
        self.assertEqual((answer.returncode, answer.stdout.strip(), answer.stderr), (0, "1", ""))

    def test_blas_is_as_the_command_line_wants_it(self):
        answer = python("-c", "import carom; print(carom._carom.blas_kernels()[1])")
        self.assertEqual(answer.stdout.strip(), "")

    def test_kernels_that_others_have_chosen_are_warned_of(self):
        # As if OpenBLAS had taken this processor for an old one before carom came.
        code = ("import os; os.environ['OPENBLAS_CORETYPE'] = 'NEHALEM'; import numpy; numpy.dot([1.0], [1.0]); "
                "del os.environ['OPENBLAS_CORETYPE']; import carom")
        deserved = python("-c", "import carom._environment as e; print(e._deserved_kernels())").stdout.strip()
        if deserved == "None":
            self.skipTest("this processor deserves no better kernels")
        answer = python("-c", code)
        self.assertIn("OPENBLAS_CORETYPE=" + deserved, answer.stderr)


class TutorialTest(unittest.TestCase):
    def test_scripts_begin_with_what_they_show(self):
        scripts = sorted(EXAMPLES.glob("*.py"))
        self.assertEqual(len(scripts), 5)
        page = (EXAMPLES.parents[1] / "docs/python.md").read_text()
        for script in scripts:
            self.assertRegex(ast.get_docstring(ast.parse(script.read_text())), "^Shows ", script.name)
            self.assertIn(script.name, page)


class PageTest(FolderTest):
    def test_examples_of_the_page_run(self):
        """Those of docs/python.md, one after the other, with a case of examples/python as case.toml."""
        page = (EXAMPLES.parents[1] / "docs/python.md").read_text()
        blocks = re.findall(r"^```python\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
        self.assertGreater(len(blocks), 7)
        shutil.copy(EXAMPLES / "falling_block.toml", "case.toml")
        names, missing = {}, ""
        for block in blocks:
            try:
                with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
                    exec(compile(block, "docs/python.md", "exec"), names)
            except ImportError as error:
                missing = str(error)
        if missing:
            self.skipTest(missing)


if __name__ == "__main__":
    unittest.main()
