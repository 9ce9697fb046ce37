// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/files/vtk_bytes.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>

namespace pcl_sq {
namespace {

/** \brief The parts as one VTK data set. \param[in] colors empty: no colours */
vtkNew<vtkPolyData> toPolyData(const std::vector<TriangleMesh>& parts,
                               const std::vector<Color>& colors) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIntArray> numbers;
  numbers->SetName("part");
  vtkNew<vtkUnsignedCharArray> rgb;
  rgb->SetName("RGB");
  rgb->SetNumberOfComponents(3);
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const vtkIdType first = points->GetNumberOfPoints();
    for (const Eigen::Vector3d& v : parts[part].vertices) {
      points->InsertNextPoint(v.data());
      if (!colors.empty()) {
        const unsigned char c[] = {colors[part].r, colors[part].g, colors[part].b};
        rgb->InsertNextTypedTuple(c);
      }
    }
    for (const auto& t : parts[part].triangles) {
      cells->InsertNextCell({first + t[0], first + t[1], first + t[2]});
      numbers->InsertNextValue(static_cast<int>(part + 1));
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  if (!colors.empty()) {
    data->GetPointData()->SetScalars(rgb);
    data->GetCellData()->AddArray(numbers);
  }
  return data;
}

} // namespace

std::string pngBytes(const SnapshotImage& image) {
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
  vtkUnsignedCharArray* bytes = writer->GetResult();
  if (bytes == nullptr || writer->GetErrorCode() != 0)
    return {};
  return {reinterpret_cast<const char*>(bytes->GetPointer(0)),
          static_cast<std::size_t>(bytes->GetNumberOfValues())};
}

std::string vtpBytes(const std::vector<TriangleMesh>& parts,
                     const std::vector<Color>& colors) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(toPolyData(parts, colors));
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0 || writer->GetErrorCode() != 0)
    return {};
  return writer->GetOutputString();
}

} // namespace pcl_sq
