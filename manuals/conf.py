# Sphinx configuration of the manuals. Built by the CMake target `manuals`, which passes the folder
# of generated pages: -D cleave_generated=FOLDER.
import pathlib
import re
import sys

here = pathlib.Path(__file__).parent
sys.path.insert(0, str(here / "tools"))

project = "Cleave"
author = "the Cleave authors"
copyright = "the Cleave authors"
version = release = re.search(r"VERSION (\d+\.\d+\.\d+)", (here.parent / "CMakeLists.txt").read_text()).group(1)

extensions = ["myst_parser", "manual_pages"]
myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 3
source_suffix = [".md"]
exclude_patterns = ["tools"]
html_math_renderer = "mathml"

html_theme = "alabaster"
html_theme_options = {
    "description": "Impact and dynamic fracture with particle methods",
    "fixed_sidebar": True,
    "page_width": "1160px",
    "sidebar_width": "230px",
    "show_powered_by": False,
    "show_relbars": True,
}
html_static_path = ["static"]
html_css_files = ["cleave.css"]
html_sidebars = {"**": ["about.html", "navigation.html", "searchbox.html"]}
html_show_sourcelink = False
html_title = "Cleave " + version
highlight_language = "none"
