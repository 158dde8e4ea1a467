"""Tests of scripts/syntax: joined sources are taken apart, precompiled headers are left out, a seed chooses, and faults are told."""
import contextlib
import io
import json
import shutil
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import made_up

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
syntax = made_up.script("syntax")

BY_GCC = "c++ -Ilib -O3 -std=c++20 -Winvalid-pch -include build/pch.hxx -o a.o -c {}"
BY_CLANG = ("clang++ -Ilib -std=c++20 -Winvalid-pch -Xclang -include-pch -Xclang b/pch.hxx.pch -Xclang -include -Xclang b/pch.hxx "
            "-o a.o -c {}")
SOUND = "#include <vector>\nint size_of(const std::vector<int>& of) { return static_cast<int>(of.size()); }\n"
FORGETS = SOUND.partition("\n")[2]
SHADOWS = "constexpr int far = 3;\nint twice(int n) {\n  const int far = n;\n  return 2 * far;\n}\n"


class Commands(unittest.TestCase):
    def test_outputs_and_precompiled_headers_are_left_out(self):
        for line, words in ((BY_GCC, ["c++", "-Ilib", "-O3", "-std=c++20"]), (BY_CLANG, ["clang++", "-Ilib", "-std=c++20"])):
            self.assertEqual(syntax.words_of({"command": line.format("/a/b.cpp"), "file": "/a/b.cpp", "directory": "/a"}), words)

    def test_joined_sources_are_taken_apart_and_those_of_the_build_left_out(self):
        with tempfile.TemporaryDirectory() as root:
            root = Path(root)
            folder = root / "build/CMakeFiles/base.dir/Unity"
            folder.mkdir(parents=True)
            joined = folder / "unity_0_cxx.cxx"
            joined.write_text("\n".join(f'/* NOLINT */\n#include "{root}/lib/{name}.cpp"\n' for name in "ab"), encoding="utf-8")
            entries = [{"command": BY_GCC.format(file), "file": str(file), "directory": str(root / "build")}
                       for file in (joined, root / "lib/c.cpp", root / "build/generated/d.cpp")]
            found = syntax.commands_of(entries, root)
            self.assertEqual(list(found), ["lib/a.cpp", "lib/b.cpp", "lib/c.cpp"])
            self.assertEqual(found["lib/b.cpp"][0][-4:], [*syntax.STRICT, str(root / "lib/b.cpp")])


class Choice(unittest.TestCase):
    PATHS = [f"lib/{n}.cpp" for n in range(100)]

    def test_a_seed_chooses_the_same_and_another_seed_others(self):
        one = syntax.some_of(self.PATHS, "7", 10)
        self.assertEqual(one, syntax.some_of(self.PATHS[::-1], "7", 10))
        self.assertEqual(len(one), 10)
        self.assertNotEqual(one, syntax.some_of(self.PATHS, "8", 10))

    def test_every_source_has_its_turn(self):
        self.assertEqual({path for seed in range(200) for path in syntax.some_of(self.PATHS, seed, 10)}, set(self.PATHS))

    def test_without_git_the_seed_is_zero(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(syntax.commit_of(folder), "0")


@unittest.skipUnless(shutil.which("c++"), "no compiler")
class Faults(unittest.TestCase):
    def check(self, *arguments, **texts):
        """(status, what is printed) for a tree of these sources."""
        with tempfile.TemporaryDirectory() as root:
            root = Path(root).resolve()
            for name, text in texts.items():
                (root / f"{name}.cpp").write_text(text, encoding="utf-8")
            (root / "build").mkdir()
            (root / "build/compile_commands.json").write_text(json.dumps(
                [{"command": f"c++ -std=c++20 -c {root}/{name}.cpp", "file": f"{root}/{name}.cpp", "directory": str(root / "build")}
                 for name in texts]), encoding="utf-8")
            said = io.StringIO()
            with contextlib.redirect_stdout(said), mock.patch.object(syntax, "ROOT", root):
                status = syntax.main(["--build", str(root / "build"), *arguments])
        return status, said.getvalue()

    def test_a_sound_source_passes_and_the_seed_is_said(self):
        status, said = self.check("--seed", "7", sound=SOUND)
        self.assertEqual(status, 0, said)
        self.assertIn("seed 7\n1 of 1 sources, 0 with faults", said)

    def test_a_forgotten_include_and_a_shadowed_name_are_found(self):
        status, said = self.check("--all", "--jobs", "2", sound=SOUND, forgets=FORGETS, shadows=SHADOWS)
        self.assertEqual(status, 1)
        self.assertIn("forgets.cpp: does not compile by itself", said)
        self.assertIn("shadows.cpp: does not compile by itself", said)
        self.assertIn("3 of 3 sources, 2 with faults", said)

    def test_parts_of_a_path_choose(self):
        self.assertEqual(self.check("soun", sound=SOUND, forgets=FORGETS)[0], 0)

    def test_a_folder_without_commands_is_skipped(self):
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(io.StringIO()):
            self.assertEqual(syntax.main(["--build", folder]), syntax.SKIPPED)


if __name__ == "__main__":
    unittest.main()
