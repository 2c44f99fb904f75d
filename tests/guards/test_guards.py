"""Every rule of the guards is seen to fail: a small tree that is in order, and one with each mistake."""
import pathlib
import tempfile
import unittest

import c_interface
import dependencies
import equations
import formatting
import fortran
import instruction_sets
import keys
import source_text
import versions
from tree import Tree, calls, without_comments


class TreeTest(unittest.TestCase):
    def test_table_lines_are_split_with_strings_joined(self):
        text = '// CLEAVE_KEY(comment)\nCLEAVE_KEY(run, t_end, "a, (b)" " c",\n  "")\n'
        self.assertEqual(list(calls(text, "CLEAVE_KEY")), [["run", "t_end", "a, (b) c", ""]])

    def test_comments_are_blanked_strings_and_lines_kept(self):
        self.assertEqual(without_comments('a; // b\n/* c\n*/ "// d"'), 'a;     \n    \n   "// d"')


class GuardTest(unittest.TestCase):
    def assert_quiet(self, guard, files):
        self.assertEqual(guard.check(Tree(files)), [])

    def assert_complains(self, guard, files, *texts):
        complaints = guard.check(Tree(files))
        self.assertEqual(len(complaints), len(texts), complaints)
        for complaint, text in zip(complaints, texts):
            self.assertIn(text, complaint)


class InstructionSets(unittest.TestCase):
    def test_symbols_of_the_set_and_local_ones_are_in_order(self):
        listing = ("0000000000000000 D _ZN11cleave_avx27kernelsE\n"
                   "0000000000000010 W _ZSt4fillIN11cleave_avx24PackILi4ELi4EEEEvPT_S4_RKS3_\n"
                   "0000000000000020 t _ZL5local\n"
                   "                 U memcpy\n")
        self.assertEqual(instruction_sets.complaints(listing, "avx2"), [])

    def test_what_the_linker_could_share_is_refused(self):
        for letter, symbol in [("W", "_ZSt4fillIdEvPT_S0_RKS0_"), ("T", "_ZN6cleave6updateEv"),
                               ("V", "_ZTIN11cleave_call6LawE"), ("u", "_ZZN6cleave1fEvE1x"),
                               ("T", "_ZN13cleave_avx5126updateEv")]:
            found = instruction_sets.complaints(f"0000000000000000 {letter} {symbol}\n", "avx2")
            self.assertEqual(len(found), 1, symbol)
            self.assertIn(symbol, found[0])


class Dependencies(GuardTest):
    HOUSE = {
        "kernels/src/core/tensor.hpp": "#include <array>\n#include <Eigen/Core>\n",
        "kernels/src/core/bonds.cpp": '#include "core/tensor.hpp"\n#include "cleave/cleave.h"\n',
        "kernels/include/cleave/cleave.h": '#include "cleave/version.h"\n#include "cleave/tables/status.def"\n',
        "io/mesh.hpp": "#include <netcdf.h>\n",
        "io/mesh.cpp": '#include "io/mesh.hpp"\n',
        "driver/src/run/step.cpp": '#include "run/step.hpp"\n#include "io/mesh.hpp"\n#include "cleave/cleave.h"\n',
        "driver/src/run/step.hpp": "",
        "tests/kernels/test.cpp": '#include "core/tensor.hpp"\n',
    }

    def test_the_house_in_order(self):
        self.assert_quiet(dependencies, self.HOUSE)

    def test_forbidden_directions(self):
        for path, include, reason in [
                ("kernels/src/core/tensor.hpp", '"io/mesh.hpp"', "not a file this folder may include"),
                ("kernels/src/core/tensor.hpp", '"../../../io/mesh.hpp"', "in a folder this one must not know"),
                ("kernels/src/core/tensor.hpp", "<netcdf.h>", "not used in this folder"),
                ("io/mesh.hpp", '"cleave/cleave.h"', "not used in this folder"),
                ("io/mesh.hpp", '"driver/src/run/step.hpp"', "must not know"),
                ("driver/src/run/step.cpp", '"core/tensor.hpp"', "cleave/cleave.h only"),
                ("driver/src/run/step.cpp", '"kernels/src/core/tensor.hpp"', "must not know"),
                ("driver/src/run/step.cpp", "<exodusII.h>", "not used in this folder")]:
            with self.subTest(path=path, include=include):
                broken = dict(self.HOUSE, **{path: self.HOUSE[path] + f"#include {include}\n"})
                self.assert_complains(dependencies, broken, reason)


class Equations(GuardTest):
    THEORY = "```{math}\n:label: cbm-8\nF\n```\n```{math}\n:label: cbm-21\n```\n```{math}\n:label: cbm-4-6\n```\n"

    def test_tags_with_ranges_and_lists(self):
        self.assert_quiet(equations, {"manuals/theory/cbm.md": self.THEORY,
                                      "kernels/a.hpp": "// [CBM 8] [CBM 21, 4-6] [CBM 5] and v[i 8]"})

    def test_unknown_tag(self):
        self.assert_complains(equations, {"manuals/theory/cbm.md": self.THEORY, "kernels/a.hpp": "\n// [CBM 8, 9]"},
                              "kernels/a.hpp:2: [CBM 8, 9] is not in manuals/theory")

    def test_tag_written_in_words(self):
        self.assert_complains(equations, {"manuals/theory/cbm.md": self.THEORY, "io/a.hpp": "// [CBM eight]"}, "cbm-eight")

    def test_tag_broken_over_two_lines(self):
        self.assert_complains(equations, {"manuals/theory/cbm.md": self.THEORY, "io/a.hpp": "// [CBM 8,\n// 21]"},
                              "goes on in the next line")

    def test_equation_labelled_twice(self):
        self.assert_complains(equations, {"manuals/theory/cbm.md": self.THEORY + ":label: cbm-5\n"}, "keep one")

    def test_no_theory(self):
        self.assert_complains(equations, {"kernels/a.hpp": "// [CBM 8]"}, "no pages found")


class Versions(GuardTest):
    TREE = {"CMakeLists.txt": "project(Cleave VERSION 1.2.3)", "CHANGELOG.md": "# Changes\n\n## 1.2.3\n",
            "driver/src/deck/keys.def": 'CLEAVE_KEY(run, a, real, "", "", "", "text", "1.2")\n'}

    def test_in_order(self):
        self.assert_quiet(versions, self.TREE)

    def test_second_copy(self):
        self.assert_complains(versions, dict(self.TREE, **{"README.md": "Cleave 1.2.3"}), "written down again")

    def test_changelog_behind(self):
        self.assert_complains(versions, dict(self.TREE, **{"CHANGELOG.md": "## 1.2.2\n"}), "not '## 1.2.3'")

    def test_key_ahead(self):
        ahead = self.TREE["driver/src/deck/keys.def"].replace('"1.2"', '"1.3"')
        self.assert_complains(versions, dict(self.TREE, **{"driver/src/deck/keys.def": ahead}), "says since 1.3")


class SourceText(GuardTest):
    def test_in_order(self):
        self.assert_quiet(source_text, {
            "kernels/a.cpp": '// std::cout is forbidden\nstd::mt19937_64 engine(42);\nstd::signal(SIGSEGV, SIG_DFL);\nint n = snprintf(text, size, "%d", 1);\n',
            "driver/main.cpp": "std::cout << text;\n",
            "tests/perf/a.cpp": "std::cout << rate;\n",
            "tests/io/program.cpp": "int main() { std::cout << 1; }\n",
            "tests/io/random.py": "random = Random(7)\nx = random.choice(y)\n",
            "manuals/decks/a.nml": "&run /\n", "manuals/a.md": "```\n&run /\n```\n",
            "README.md": "[deck](validation/a.nml) [web](https://example.org/a.md)", "validation/a.nml": "x = 'w/tmp'\n"})

    def test_each_mistake(self):
        for path, text, complaint in [
                ("kernels/a.cpp", "std::cout << 1;", "do not print"),
                ("io/a.cpp", 'printf("x");', "do not print"),
                ("tests/io/a.cpp", "std::cerr << 1;", "do not print"),
                ("kernels/a.cpp", "std::abort();", "never ends its host"),
                ("io/a.cpp", "assert(x);", "never ends its host"),
                ("io/a.cpp", "std::signal(SIGINT, handle);", "never ends its host"),
                ("tests/io/a.cpp", "std::mt19937 engine;", "seed"),
                ("kernels/a.cpp", "std::random_device d;", "seed"),
                ("validation/a.py", "g = np.random.default_rng()", "seed"),
                ("CMakeLists.txt", "add_compile_options(-f" "fast-math)", "keep their order"),
                ("kernels/a.cpp", "#pragma omp atomic", "keep their order"),
                ("kernels/a.cpp", "std::atomic<double> sum;", "keep their order"),
                ("io/a.cpp", "std::stod(text)", "locale"),
                ("io/a.cpp", "// TO" "DO", "finish it"),
                ("manuals/a.md", "see /ho" "me/me/a", "one machine"),
                ("manuals/a.md", "[deck](missing.nml)", "leads nowhere"),
                ("validation/a.py", "x = random.choice(y)", "seed"),
                ("manuals/a.md", "text\n```\n&run /\n```\n", "no file of manuals/decks"),
                ("io/a.cpp", "\n" * 701, "split it")]:
            with self.subTest(path=path, text=text[:30]):
                self.assert_complains(source_text, {path: text}, complaint)


class CInterface(GuardTest):
    TREE = {
        "kernels/include/cleave/cleave.h": "/* Does. */\nCLEAVE_API int32_t cleave_do(int n);\n",
        "kernels/include/cleave/tables/status.def":
            'CLEAVE_STATUS(OK, 0, "no error")\nCLEAVE_STATUS(BAD, 1, "wrong")\n',
        "kernels/src/abi/do.cpp": "int32_t cleave_do(int n) { return CLEAVE_BAD; }\n",
        "tests/abi/do.cpp": "EXPECT_EQ(cleave_do(1), CLEAVE_BAD);\n",
    }
    HEADER = "kernels/include/cleave/cleave.h"

    def test_in_order(self):
        self.assert_quiet(c_interface, self.TREE)

    def test_function_without_comment(self):
        self.assert_complains(c_interface, dict(self.TREE, **{
            self.HEADER: "/* A section. */\n\nCLEAVE_API int32_t cleave_do(int n);\n"}), "has no comment")

    def test_function_not_called(self):
        self.assert_complains(c_interface, dict(self.TREE, **{"tests/abi/do.cpp": "// cleave_do(1)"}), "is called neither")

    def test_function_not_defined(self):
        self.assert_complains(c_interface, dict(self.TREE, **{"kernels/src/abi/do.cpp": "return CLEAVE_BAD;"}),
                              "is not defined")

    def test_status_never_raised(self):
        self.assert_complains(c_interface, dict(self.TREE, **{
            "kernels/src/abi/do.cpp": "int32_t cleave_do(int n) { return 0; }\n"}), "BAD is never raised")

    def test_function_missing_in_fortran(self):
        self.assert_complains(c_interface, dict(self.TREE, **{"kernels/fortran/cleave.f90": "module cleave\n"}),
                              "missing in kernels/fortran")


class Fortran(GuardTest):
    PAGE = "manuals/reference/fortran.md"
    TREE = {
        "kernels/include/cleave/cleave.h": "/* Do. */\nCLEAVE_API int32_t cleave_do(int n);\n"
                                           "CLEAVE_API int32_t cleave_base(int n);\n",
        "kernels/fortran/module/c.f90":
            "    function cleave_do(n) &\n        bind(C) result(status)\n"
            "    function cleave_base(n) bind(C) result(status)\n",
        "kernels/fortran/module/do.f90.in":
            "  interface cleave_do\n    module procedure do_it\n  end interface cleave_do\n"
            "  recursive function do_it(model, &\n      n) result(status)\n",
        "kernels/fortran/f77/do.f90": "recursive subroutine cldo(mod, n, ierr)\n",
        "manuals/reference/fortran.md":
            "| `cleave_do` | `(model, n)` | `CLDO(MOD, N, IERR)` |\n"
            "| `cleave_base` | not offered: it counts from 1 | not offered: the same |\n",
    }

    def complaint(self, path, old, new, *texts):
        self.assertIn(old, self.TREE[path])
        self.assert_complains(fortran, dict(self.TREE, **{path: self.TREE[path].replace(old, new)}), *texts)

    def test_in_order(self):
        self.assert_quiet(fortran, self.TREE)

    def test_function_not_bound(self):
        self.complaint("kernels/fortran/module/c.f90", "cleave_base", "cleave_bass", "cleave_base is not bound")

    def test_function_not_offered_without_a_reason(self):
        self.complaint("kernels/fortran/module/do.f90.in", "interface cleave_do\n", "interface cleave_dont\n",
                       "cleave_do is not in module cleave")

    def test_function_without_a_subroutine(self):
        self.complaint(self.PAGE, "not offered: the same", "none", "name the subroutine for cleave_base")

    def test_function_without_a_line(self):
        self.complaint(self.PAGE, "`cleave_base`", "cleave_base", "cleave_base has no line")

    def test_line_without_a_function(self):
        self.complaint(self.PAGE, "| `cleave_base`", "| `cleave_old` | `()` | not offered: gone |\n| `cleave_base`",
                       "cleave_old is no function")

    def test_other_arguments(self):
        self.complaint(self.PAGE, "(model, n)", "(n)", "cleave_do takes (model, n)")
        self.complaint(self.PAGE, "CLDO(MOD, N, IERR)", "CLDO(N, IERR)", "CLDO takes (MOD, N, IERR)")

    def test_subroutines(self):
        self.complaint("kernels/fortran/f77/do.f90", "cldo", "cldodone", "more than six", "CLDO is no subroutine",
                       "CLDODONE is missing")


class Keys(GuardTest):
    TREE = {
        "driver/src/deck/keys.def":
            'CLEAVE_GROUP(run, once, "Run (all)")\nCLEAVE_GROUP(material, many, "Law")\n'
            'CLEAVE_KEY(run, t_end, real, "", "s", "> 0", "end, of time", "0.1")\n'
            'CLEAVE_KEY(run, title, text, "", "", "", "a line", "0.1")\n'
            'CLEAVE_PARAMETER_KEY(body, text, "", "", "", "body", "0.1")\n',
        "kernels/src/tables/groups.def": 'CLEAVE_GROUP(fracture, kSpecs, "Breaking", "")\n',
        "kernels/src/material/law.hpp": 'required_parameter(\n    "E", "Pa")\n',
        "validation/a/a.nml": "&run title = 'x = /', t_end = 1 /\n&material\n  E(1) = 3 ! rho = 2\n/\n"
                              "&fracture body = 'b' /\n",
    }

    def test_in_order(self):
        self.assert_quiet(keys, self.TREE)

    def test_key_without_a_deck(self):
        less = self.TREE["validation/a/a.nml"].replace("title = 'x = /', ", "")
        self.assert_complains(keys, dict(self.TREE, **{"validation/a/a.nml": less}), "run.title is in no deck")

    def test_parameter_without_a_deck(self):
        less = self.TREE["validation/a/a.nml"].replace("E(1) = 3", "")
        self.assert_complains(keys, dict(self.TREE, **{"validation/a/a.nml": less}), "parameter e is in no deck")

    def test_bad_decks_do_not_count(self):
        moved = dict(self.TREE, **{"tests/driver/bad_decks/a.nml": self.TREE["validation/a/a.nml"]})
        del moved["validation/a/a.nml"]
        self.assert_complains(keys, moved, "parameter e", "fracture.body is in no deck", "run.t_end is in no deck",
                              "run.title is in no deck")

    def test_deck_with_an_old_key_or_group(self):
        self.assert_complains(keys, dict(self.TREE, **{"manuals/b.nml": "&run\n t_stop = 1\n/\n&walk\n/\n&walk a=1/\n"}),
                              "no key run.t_stop", "no group walk")


class Formatting(GuardTest):
    def test_unformatted(self):
        if formatting._version("clang-format") != 14:
            self.skipTest("clang-format 14 is not here")
        with tempfile.TemporaryDirectory() as root:
            folder = pathlib.Path(root, "kernels")
            folder.mkdir()
            (folder / "good.cpp").write_text("int a;\n")
            self.assertEqual(formatting.check(Tree.from_directory(root)), [])
            (folder / "bad.cpp").write_text("int a;\nint   b ;\nint   c;\n")
            self.assertEqual(formatting.check(Tree.from_directory(root)),
                             ["kernels/bad.cpp:2: run clang-format -i kernels/bad.cpp"])


if __name__ == "__main__":
    unittest.main()
