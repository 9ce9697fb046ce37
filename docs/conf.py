# SPDX-License-Identifier: BSD-3-Clause
"""The site: scripts/docs.sh builds it."""
import os
import re

here = os.path.dirname(os.path.abspath(__file__))
project = "pcl_sq"
author = "pcl_sq contributors"
copyright = author
version = release = re.search(r"project\(pcl_sq VERSION ([0-9.]+)", open(
    os.path.join(here, "..", "CMakeLists.txt")).read()).group(1)
extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc", "sphinx.ext.mathjax"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
source_suffix = {".md": "markdown"}
exclude_patterns = ["_build"]
html_theme = "furo"
html_title = "pcl_sq " + version
html_show_sphinx = False
mathjax_path = "file:///usr/share/javascript/mathjax/MathJax.js"
breathe_projects = {"pcl_sq": os.environ.get("PCL_SQ_DOXYGEN_XML", "")}
breathe_default_project = "pcl_sq"
# names of Eigen, PCL and std are not of this site
nitpicky = False
autodoc_typehints = "description"
autodoc_member_order = "bysource"
