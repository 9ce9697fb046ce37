// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/files/png_file.h"

#include "pcl_sq/exception.h"
#include "pcl_sq/file_io.h"
#include "visualization/frame_renderer.h"

namespace pcl_sq {

void checkPngPath(const std::string& path, const std::string& who) {
  if (formatOf(path, ".png") != ".png")
    throw Exception("[" + who + "] " + path +
                    " does not end in .png, the one format of pictures; rename it.");
  std::string why;
  if (!isWritable(path, &why))
    throw Exception("[" + who + "] " + why + ".");
}

void writePng(const std::string& path,
              const SnapshotImage& image,
              const std::string& who) {
  const std::string bytes = vtkPart(who).pngBytes(image);
  std::string why = "the picture cannot be made into a PNG file; make it smaller";
  if (bytes.empty() || !writeFile(path, bytes, &why))
    throw Exception("[" + who + "] " + why + ".");
}

} // namespace pcl_sq
