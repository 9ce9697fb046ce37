// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/files/png_file.h"

#include "pcl_sq/exception.h"
#include "pcl_sq/file_io.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

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
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.width, image.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const std::size_t row = 3 * static_cast<std::size_t>(image.width);
  for (int y = 0; y < image.height; ++y)
    std::copy_n(image.rgb.begin() + static_cast<std::ptrdiff_t>(row * y),
                row,
                static_cast<unsigned char*>(
                    data->GetScalarPointer(0, image.height - 1 - y, 0)));
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(data);
  writer->WriteToMemoryOn();
  writer->Write();
  const vtkUnsignedCharArray* bytes = writer->GetResult();
  std::string why = "the picture cannot be made into a PNG file; make it smaller";
  if (bytes == nullptr || writer->GetErrorCode() != 0 ||
      !writeFile(
          path,
          std::string(reinterpret_cast<const char*>(writer->GetResult()->GetPointer(0)),
                      static_cast<std::size_t>(bytes->GetNumberOfValues())),
          &why))
    throw Exception("[" + who + "] " + why + ".");
}

} // namespace pcl_sq
