#!/usr/bin/env python3
"""harden.py refuses what it does not know, and then writes nothing.

usage: harden_test.py LCM_GEN
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HARDEN = Path(__file__).resolve().parents[2] / "lcmtypes" / "harden.py"
LCM_GEN = "lcm-gen"
DEFINITION = """package p;
struct t_t
{
  int32_t n;
  string  name;
  float   values[n];
  int8_t  grid[n][2];
}
"""


class HardenTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.output = self.folder / "out" / "t_t.hpp"

    def generate(self, definition):
        self.definition = self.folder / "t_t.lcm"
        self.definition.write_text(definition)
        subprocess.run([LCM_GEN, "-x", "--cpp-std=c++11", "--cpp-hpath", self.folder, self.definition], check=True)
        return self.folder / "p" / "t_t.hpp"

    def harden(self, header):
        command = [sys.executable, HARDEN, self.definition, header, self.output]
        return subprocess.run(command, capture_output=True, text=True)

    def expect_refused(self, header, why):
        result = self.harden(header)
        self.assertEqual(result.returncode, 1)
        self.assertIn(why, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertFalse(self.output.exists())

    def changed(self, old, new):
        header = self.generate(DEFINITION)
        text = header.read_text()
        self.assertIn(old, text)
        header.write_text(text.replace(old, new, 1))
        return header

    def test_hardens_what_it_knows(self):
        result = self.harden(self.generate(DEFINITION))
        self.assertEqual(result.returncode, 0, result.stderr)
        text = self.output.read_text()
        self.assertEqual(text.count("has_sizes("), 2)
        self.assertEqual(text.count("array_fits("), 4)
        self.assertEqual(text.count("is_string("), 1)

    def test_refuses_a_header_already_hardened(self):
        self.harden(self.generate(DEFINITION))
        hardened = self.output.rename(self.folder / "hardened.hpp")
        self.expect_refused(hardened, "cannot be hardened")

    def test_refuses_a_header_of_another_definition(self):
        header = self.generate(DEFINITION)
        self.definition.write_text(DEFINITION.replace("float   values[n];", ""))
        self.expect_refused(header, "vectors are not the definition's arrays")

    def test_refuses_a_decode_that_resizes_elsewhere(self):
        self.expect_refused(self.changed("this->values.resize(", "this->values.reserve("), "resized 0 times")

    def test_refuses_another_check_of_a_length(self):
        self.expect_refused(self.changed("_len__ > maxlen - pos) return -1;", "_len__ >= maxlen) return -1;"),
                            "length of 'name'")

    def test_refuses_members_in_another_order(self):
        header = self.generate(DEFINITION)
        self.definition.write_text(DEFINITION.replace("  int32_t n;\n", "").replace("}", "  int32_t n;\n}"))
        self.expect_refused(header, "is not where it should be")

    def test_refuses_another_form_of_function(self):
        self.expect_refused(self.changed("int t_t::_getEncodedSizeNoHash() const\n{", "int t_t::other() const\n{"),
                            "_getEncodedSizeNoHash")

    def test_refuses_a_type_that_holds_itself(self):
        self.expect_refused(self.generate("package p;\nstruct t_t { int32_t n; t_t children[n]; }\n"), "holds itself")

    def test_refuses_a_type_of_no_bytes(self):
        self.expect_refused(self.generate("package p;\nstruct t_t { }\n"), "no bytes")

    def test_refuses_a_definition_that_it_cannot_read(self):
        header = self.generate(DEFINITION)
        self.definition.write_text(DEFINITION + "struct other_t { int8_t x; }\n")
        self.expect_refused(header, "not one package with one struct")


if __name__ == "__main__":
    LCM_GEN = sys.argv.pop(1)
    unittest.main()
