"""The page made from cleave.h holds every declaration of it; tags and labels of equations are understood."""
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "manuals/tools"))

import c_interface  # noqa: E402

HEADER = (ROOT / "kernels/include/cleave/cleave.h").read_text(encoding="utf-8")


class CInterfacePage(unittest.TestCase):
    def test_every_function_type_and_section_of_the_header_is_there(self):
        page = c_interface.page(HEADER)
        wanted = set(re.findall(r"\b(?:cleave|CLEAVE)_\w+", re.sub(r"(?m)^#.*$", "", HEADER)))
        self.assertGreater(len(wanted), 100)
        self.assertEqual({name for name in wanted if not re.search(rf"\b{name}\b", page)}, set())
        for section in re.findall(r"/\* -{4,} (.*?) -{4,} \*/", HEADER):
            self.assertIn(f"## {section.capitalize()}\n", page)

    def test_small_header(self):
        page = c_interface.page('/* About. */\n#ifndef CLEAVE_H\n#define CLEAVE_H\n/* ---- part one ---- */\n\n/* Does this\n'
                                ' * and that. */\nCLEAVE_API int f(void);\n/* [in] n   count\n * [out] x  value */\n'
                                'CLEAVE_API int cleave_g(int n);\n#endif\n')
        self.assertIn("About.", page)
        self.assertIn("## Part one", page)
        self.assertIn("Does this and that.\n\n```c\nCLEAVE_API int f(void);\n```", page)
        self.assertIn("```text\n[in] n   count\n[out] x  value\n```\n\n(cleave_g)=\n```c", page)
        self.assertNotIn("#", page.replace("## Part one", ""))

    def test_code_fences_are_balanced(self):
        fences = [line for line in c_interface.page(HEADER).splitlines() if line.startswith("```")]
        self.assertEqual([fence == "```" for fence in fences], [False, True] * (len(fences) // 2))


if __name__ == "__main__":
    unittest.main()
