"""Every check of scripts/house.py can fail: each test breaks a small sound tree in one place."""
import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import house  # noqa: E402  (after the path)

SOUND = {
    "CMakeLists.txt": "nereid_module(base      )\n"
                      "nereid_module(mesh     base)\n"
                      "nereid_module(grid     mesh PRIVATE ${NEREID_VTK})\n"
                      "nereid_module(element  mesh)\n"
                      "nereid_module(contact  mesh)\n"
                      "nereid_module(input    element PRIVATE yaml-cpp)\n"
                      "nereid_module(output   element grid PRIVATE nlohmann_json)\n",
    "lib/base/types.hpp": "#include <Eigen/Core>\n",
    "lib/base/number.hpp": "#include <experimental/simd>\n",
    "lib/base/parallel.hpp": "#include <vector>\n",
    "lib/base/parallel.cpp": "#include <atomic>\n#include <thread>\n",
    "lib/mesh/box.hpp": '#include <vector>\n#include "base/types.hpp"\n',
    "lib/mesh/box.cpp": '#include "mesh/box.hpp"\n#include <Eigen/Eigenvalues>\n',
    "lib/element/hex8.hpp": '#include "base/number.hpp"\n#include "mesh/box.hpp"\n',
    "lib/contact/tracking/element.hpp": '#include "mesh/box.hpp"\n',
    "lib/input/yaml.cpp": "#include <yaml-cpp/yaml.h>\n",
    "lib/grid/grid.cpp": "#include <vtkPoints.h>\n",
    "lib/output/summary.cpp": "#include <nlohmann/json.hpp>\n",
    "drivers/driver.cpp": "#include <CLI/CLI.hpp>\n",
    "scripts/figure.py": "import matplotlib\n",
    "scripts/look": "#!/usr/bin/python3\nimport figure\n",
    "docs/page.md": "A plain page. TODO(#12): say more.\n",
    "tests/mesh/box_test.cpp": "#include <gtest/gtest.h>\n",
    "tests/base/number_test.cpp": "",
    "tests/base/parallel_test.cpp": "",
    "tests/element/hex8_test.cpp": "",
    "tests/contact/tracking/element_test.cpp": "",
    "tests/scripts/figure_test.py": "",
}
NEEDS_NO_TEST = {"lib/base/types.hpp": "names only"}


class HouseTest(unittest.TestCase):
    def look(self, check, changes=None, without=()):
        """Exit status and faults of one check on the sound tree with changes."""
        files = {path: text for path, text in {**SOUND, **(changes or {})}.items() if path not in without}
        with tempfile.TemporaryDirectory() as root:
            for path, text in files.items():
                (Path(root) / path).parent.mkdir(parents=True, exist_ok=True)
                (Path(root) / path).write_text(text, encoding="utf-8")
            said = io.StringIO()
            with contextlib.redirect_stdout(said), mock.patch.object(house, "NEEDS_NO_TEST", NEEDS_NO_TEST):
                status = house.main([check, "--root", root])
        return status, said.getvalue()

    def expect(self, check, changes, fault, without=()):
        """The change is found by this check, as the only fault, and said in these words."""
        status, said = self.look(check, changes, without)
        self.assertEqual(status, 1)
        self.assertEqual(said.count("\n"), 1, said)
        self.assertIn(fault, said)

    def test_a_sound_tree_has_no_faults(self):
        self.assertEqual(self.look("all"), (0, ""))

    def test_all_finds_the_faults_of_every_check(self):
        status, said = self.look("all", {
            "lib/mesh/box.cpp": '#include "element/hex8.hpp"\n#include <thread>\n',
            "docs/page.md": "FIX" + "ME\n", "tests/mesh/ball_test.cpp": ""})
        self.assertEqual(status, 1)
        for part in ("does not rest on", "a thread enters here", "without an issue", "tests nothing"):
            self.assertIn(part, said)


class Floors(HouseTest):
    def test_upward_include(self):
        self.expect("floors", {"lib/mesh/box.hpp": '#include <vector>\n#include "element/hex8.hpp"\n'},
                    "lib/mesh/box.hpp:2: 'mesh' includes \"element/hex8.hpp\" but does not rest on 'element'")

    def test_sideways_include(self):
        self.expect("floors", {"lib/element/hex8.hpp": '#include "contact/tracking/element.hpp"\n'},
                    "lib/element/hex8.hpp:1: 'element' includes \"contact/tracking/element.hpp\"")

    def test_upward_include_in_angle_brackets(self):
        self.expect("floors", {"lib/mesh/box.hpp": "#  include <element/hex8.hpp>\n"}, "lib/mesh/box.hpp:1:")

    def test_private_libraries_are_no_modules(self):
        self.expect("floors", {"lib/input/yaml.cpp": '#include "yaml-cpp/yaml.h"\n'}, "names no module")

    def test_include_without_module(self):
        self.expect("floors", {"lib/mesh/box.cpp": '#include "box.hpp"\n'}, "lib/mesh/box.cpp:1: \"box.hpp\" names no module")

    def test_include_by_way_of_the_parent_folder(self):
        self.expect("floors", {"lib/mesh/box.cpp": '#include "../element/hex8.hpp"\n'}, "names no module")

    def test_headers_that_the_build_writes_are_fine(self):
        self.assertEqual(self.look("floors", {"lib/mesh/box.cpp": '#include "nereid_commit.hpp"\n'}), (0, ""))

    def test_include_of_a_missing_file(self):
        self.expect("floors", {"lib/mesh/box.cpp": '#include "mesh/ball.hpp"\n'}, "does not exist below lib/")

    def test_module_that_is_not_in_the_table(self):
        self.expect("floors", {"lib/magic/wand.hpp": ""}, "lib/magic/wand.hpp:1: stands in no module")

    def test_source_outside_every_module(self):
        self.expect("floors", {"lib/nereid.hpp": ""}, "lib/nereid.hpp:1: stands in no module")

    def test_module_that_rests_on_a_higher_one(self):
        self.expect("floors", {"CMakeLists.txt": SOUND["CMakeLists.txt"].replace("(base ", "(base output")},
                    "CMakeLists.txt:1: 'base' rests on 'output', which is not defined above it")

    def test_missing_table(self):
        self.expect("floors", {"CMakeLists.txt": "project(nereid)\n"}, "no nereid_module(...) line")

    def test_missing_file_of_the_table(self):
        self.expect("floors", {}, "CMakeLists.txt:1: is missing", without=["CMakeLists.txt"])


class Doors(HouseTest):
    def test_each_dependency_behind_its_door(self):
        for path, text, fault in [
            ("lib/input/case.cpp", "#include <yaml-cpp/yaml.h>\n", "yaml-cpp enters here; its door is lib/input/yaml.cpp"),
            ("tests/input/case.cpp", "#include <yaml-cpp/node/node.h>\n", "yaml-cpp enters here"),
            ("lib/output/history.cpp", "#include <vtkPoints.h>\n", "VTK enters here; its door is lib/grid/grid.cpp"),
            ("lib/output/history.cpp", "#include <nlohmann/json.hpp>\n", "its door is lib/output/summary.cpp"),
            ("drivers/cask_drop.cpp", "#include <CLI/CLI.hpp>\n", "CLI11 enters here; its door is drivers/driver.cpp"),
            ("lib/mesh/box.cpp", "#include <thread>\n", "a thread enters here; its door is lib/base/parallel.cpp"),
            ("lib/mesh/box.cpp", "  #pragma omp simd\n", "a thread enters here"),
            ("lib/mesh/box.cpp", "#include <experimental/simd>\n", "its door is lib/base/number.hpp"),
            ("lib/mesh/box.cpp", "#include <gtest/gtest.h>\n", "a test framework enters here; it belongs in tests/"),
            ("drivers/driver.cpp", "#include <gmock/gmock.h>\n", "a test framework enters here"),
            ("verification/one/draw.py", "import matplotlib.pyplot as plt\n", "matplotlib enters here; its door is scripts/figure.py"),
            ("scripts/look", "#!/usr/bin/python3\n  from matplotlib import pyplot\n", "scripts/look:2: matplotlib enters here"),
            ("scripts/look.py", "import markdown\n", "Python-Markdown enters here; its door is scripts/verification_report.py"),
        ]:
            with self.subTest(path=path, text=text):
                self.expect("doors", {path: text}, fault)

    def test_eigen_in_a_header(self):
        self.expect("doors", {"lib/mesh/box.hpp": "#include <Eigen/Dense>\n"},
                    "lib/mesh/box.hpp:1: <Eigen/Dense> enters here; its door is lib/base/types.hpp")

    def test_eigen_in_a_source_beyond_decompositions(self):
        self.expect("doors", {"lib/mesh/box.cpp": "#include <Eigen/Core>\n"}, "<Eigen/Core> enters here")

    def test_unsupported_eigen(self):
        self.expect("doors", {"lib/mesh/box.cpp": "#include <unsupported/Eigen/AutoDiff>\n"}, "<Eigen/AutoDiff> enters here")


class Words(HouseTest):
    # The words are put together here so that this file does not hold them itself.
    def test_words_for_the_sides_of_a_contact(self):
        for word in ("mas" + "ter", "Sla" + "ve", "is_sla" + "ve_node"):
            with self.subTest(word=word):
                self.expect("words", {"lib/contact/tracking/element.hpp": f"// one\n// the {word} side\n"},
                            "lib/contact/tracking/element.hpp:2: '")

    def test_path_of_one_machine(self):
        for folder in ("work", "home", "root", "Users"):
            with self.subTest(folder=folder):
                self.expect("words", {"docs/page.md": f"see /{folder}/somebody\n"}, "is a path of one machine")

    def test_path_of_one_machine_in_a_file_of_the_top_folder(self):
        self.expect("words", {"README.md": "cd /" + "home/me\n"}, "README.md:1:")

    def test_paths_inside_the_tree_and_of_the_system_are_fine(self):
        self.assertEqual(self.look("words", {"docs/page.md": "out/work/x and /usr/bin/python3 and a/root/b\n"}), (0, ""))

    def test_host_of_a_registry(self):
        self.expect("words", {"scripts/setup.sh": "curl pypi" + ".org\n"}, "is the host of a registry")

    def test_open_end_without_an_issue(self):
        self.expect("words", {"docs/page.md": "TO" + "DO: say more\n"}, "without an issue")

    def test_files_that_are_not_text_are_passed_over(self):
        with tempfile.TemporaryDirectory() as root:
            (Path(root) / "picture.png").write_bytes(b"\x89PNG\xff\xfe")
            self.assertEqual(house.main(["words", "--root", root]), 0)


    def test_the_line_that_names_the_words_of_the_field_is_fine(self):
        self.assertEqual(self.look("words", {"docs/page.md": "secondary and primary (sla" + "ve and mas" + "ter)\n"}), (0, ""))


class Width(HouseTest):
    def look(self, check, changes=None, without=()):
        with mock.patch.object(house, "ANY_WIDTH", ["tests/*"]):
            return super().look(check, changes, without)

    def test_a_line_that_is_too_long(self):
        for path in ("scripts/look.py", "lib/mesh/box.hpp", "docs/page.md", "cases/a.yaml", "scripts/setup.sh"):
            with self.subTest(path):
                self.expect("width", {path: "a" * 140 + "\n" + "b" * 141 + "\n"}, f"{path}:2: has 141 characters")
        self.expect("width", {"scripts/look": "#!/usr/bin/python3\n" + "b" * 141 + "\n"}, "scripts/look:2:")

    def test_what_cannot_be_broken_may_be_long(self):
        table, address = "| " + "a " * 100 + "|\n", "see https://" + "a" * 140 + "\n"
        written = "<!-- written by scripts/verify.py -->\n- " + "a " * 100 + "\n<!-- end of what scripts/verify.py writes -->\n"
        self.assertEqual(self.look("width", {"docs/page.md": table + address + written}), (0, ""))
        self.expect("width", {"docs/page.md": written + "a " * 100 + "\n"}, "docs/page.md:4:")

    def test_files_that_are_not_in_order_yet(self):
        self.assertEqual(self.look("width", {"tests/mesh/box_test.cpp": "a" * 141}), (0, ""))


class Links(HouseTest):
    def test_a_link_leads_to_a_file_or_folder(self):
        page = "[a](other.md#part) [b](../lib) [c](https://example.org/x) `[](gone.md)`\n```\n[](gone.md)\n```\n"
        there = {"docs/page.md": page, "docs/other.md": "text\n", "lib/a.hpp": "// text\n"}
        self.assertEqual(self.look("links", there), (0, ""))
        self.expect("links", {"docs/page.md": "text\n[a](gone.md)\n"}, "docs/page.md:2: links to gone.md")


class Retired(HouseTest):
    on = True

    def look(self, check, changes=None, without=()):
        with mock.patch.object(house.table_of_words, "RETIRED", self.on):
            return super().look(check, changes, without)

    def test_a_word_that_has_a_new_name(self):
        self.expect("retired", {"docs/page.md": "the hardness of a contact\n"},
                    "docs/page.md:1: 'hardness' has a new name, 'penalty_scale'")
        self.expect("retired", {"verification/a/accept.py": 'run.again({"planes[0].stick": 1})\n'}, "'stick' has a new name")
        self.expect("retired", {"scripts/run.sh": "--set planes[0].kind=held\n"}, "'held' has a new name")

    def test_words_that_are_also_english_are_refused_in_their_place_only(self):
        self.assertEqual(self.look("retired", {"docs/page.md": "surfaces stick, springs[0].damping, held; they turn\n"}), (0, ""))

    def test_nothing_is_refused_before_the_words_are_retired(self):
        self.on = False
        self.assertEqual(self.look("retired", {"docs/page.md": "hardness\n"}), (0, ""))


class Circles(HouseTest):
    def test_two_modules_that_import_each_other(self):
        self.expect("circles", {"scripts/a.py": "import sys\nimport b\n", "scripts/b.py": "import a\n"},
                    "scripts/a.py:2: imports itself: a.py -> b.py -> a.py")

    def test_an_import_within_a_function_counts(self):
        self.expect("circles", {"scripts/a.py": "from b import one\n", "scripts/b.py": "import c\n",
                                "scripts/c.py": "def late():\n    import a\n    return a\n"},
                    "scripts/a.py:1: imports itself: a.py -> b.py -> c.py -> a.py")

    def test_a_circle_that_a_program_only_reaches_is_told_once(self):
        self.expect("circles", {"scripts/a.py": "import b\n", "scripts/b.py": "import a\n",
                                "scripts/run": "#!/usr/bin/python3\nimport a\n"},
                    "scripts/a.py:1: imports itself")

    def test_a_program_and_a_module_of_one_name(self):
        self.assertEqual(self.look("circles", {"scripts/figure": "#!/usr/bin/python3\nimport figure\n"}), (0, ""))

    def test_a_figure_that_imports_its_study(self):
        self.expect("circles", {"scripts/figure_bar.py": "import figure\nimport numpy\nimport bar\n", "scripts/bar.py": ""},
                    "scripts/figure_bar.py:3: imports bar.py; a figure takes data")
        self.assertEqual(self.look("circles", {"scripts/figure_bar.py": "import figure\nimport figure_head\nimport numpy\n",
                                               "scripts/figure_head.py": "from figure import plt\n",
                                               "scripts/bar.py": "import figure_bar\n"}), (0, ""))

    def test_a_file_that_is_no_python(self):
        self.expect("circles", {"scripts/a.py": "import sys\nimport\n"}, "scripts/a.py:2: is no Python")


class Mirror(HouseTest):
    def test_test_of_nothing(self):
        self.expect("mirror", {"tests/mesh/ball_test.cpp": ""}, "tests/mesh/ball_test.cpp:1: tests nothing; expected is lib/mesh/ball")

    def test_script_test_of_nothing(self):
        self.expect("mirror", {"tests/scripts/nothing_test.py": ""}, "expected is scripts/nothing")

    def test_header_without_a_test(self):
        self.expect("mirror", {}, "lib/mesh/box.hpp:1: has no test; expected is tests/mesh/box_test.cpp",
                    without=["tests/mesh/box_test.cpp"])

    def test_header_that_is_excused_but_tested(self):
        self.expect("mirror", {"tests/base/types_test.cpp": ""}, "take it off NEEDS_NO_TEST")

    def test_excuse_for_a_header_that_is_gone(self):
        self.expect("mirror", {}, "lib/base/types.hpp:1: does not exist", without=["lib/base/types.hpp"])


if __name__ == "__main__":
    unittest.main()
