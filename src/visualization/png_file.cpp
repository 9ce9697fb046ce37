// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/png_file.h"

#include "pcl_sq/exception.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>

#include <algorithm>

namespace pcl_sq {
namespace {

const std::string& checked(const std::string& path, const std::string& who) {
  requirePng(path, who);
  return path;
}

} // namespace

void requirePng(const std::string& path, const std::string& who) {
  if (lowerExtension(path) != ".png")
    throw Exception("[" + who + "] " + path +
                    " does not end in .png, the one format of pictures; rename it.");
}

PngFile::PngFile(const std::string& path, const std::string& who)
    : who_(who), path_(path), file_(checked(path, who), who) {}

void PngFile::write(const SnapshotImage& image) {
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
  writer->SetFileName(file_.temporaryPath().c_str());
  writer->Write();
  if (writer->GetErrorCode() != 0)
    throw Exception("[" + who_ + "] " + path_ +
                    " could not be written to its end; is the disk full?");
  file_.commit();
}

} // namespace pcl_sq
