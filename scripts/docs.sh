#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the site of docs/ in build-docs/site; a warning is an error: docs.sh [BUILD_DIR].
# The Python pages come from the module in BUILD_DIR/python, the tutorials' pictures from its programs.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$(cd "${1:-build}" && pwd)
./scripts/install_deps.sh doxygen python3-sphinx python3-myst-parser python3-breathe furo \
  python3-numpy libjs-mathjax
[ -d "$build/python/pcl_sq" ] || {
  echo "docs.sh: there is no Python module in $build; build it first." >&2
  exit 1
}
mkdir -p build-docs
(cat docs/Doxyfile
 echo "GENERATE_XML=YES
GENERATE_HTML=NO
INPUT=include/pcl_sq
USE_MDFILE_AS_MAINPAGE=") | doxygen - >build-docs/doxygen.log 2>&1
# the pages' pictures are those of this build
rm -rf build-docs/pages build-docs/site
mkdir build-docs/pages
cp -r docs build-docs/pages
cp CMakeLists.txt build-docs/pages
/usr/bin/python3 -B scripts/pictures.py "$build" build-docs/pages/docs/images
PCL_SQ_DOXYGEN_XML=$PWD/build-docs/xml PYTHONPATH=$build/python /usr/bin/python3 -m sphinx \
  -q -W --keep-going -b html build-docs/pages/docs build-docs/site
./scripts/check_links.py build-docs/site
echo "build-docs/site/index.html"
