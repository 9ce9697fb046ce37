// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/visualization/mesh_writer.h"

#include "pcl_sq/exception.h"
#include "pcl_sq/file_io.h"
#include "visualization/files/mesh_bytes.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

namespace pcl_sq {
namespace {

const std::string WHO = "pcl_sq::writeMesh";

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
      if (!v.allFinite())
        throw Exception("[" + WHO + "] a vertex is not finite; repair the mesh.");
      points->InsertNextPoint(v.data());
      if (!colors.empty()) {
        const unsigned char c[] = {colors[part].r, colors[part].g, colors[part].b};
        rgb->InsertNextTypedTuple(c);
      }
    }
    for (const auto& t : parts[part].triangles) {
      for (const std::uint32_t index : t)
        if (index >= parts[part].vertices.size())
          throw Exception("[" + WHO +
                          "] a triangle's vertex does not exist; repair the mesh.");
      cells->InsertNextCell({first + t[0], first + t[1], first + t[2]});
      numbers->InsertNextValue(static_cast<int>(part + 1));
    }
  }
  if (cells->GetNumberOfCells() == 0)
    throw Exception("[" + WHO + "] the mesh is empty; there is nothing to write.");
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  if (!colors.empty()) {
    data->GetPointData()->SetScalars(rgb);
    data->GetCellData()->AddArray(numbers);
  }
  return data;
}

std::string vtpBytes(vtkPolyData* data) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0 || writer->GetErrorCode() != 0)
    throw Exception("[" + WHO +
                    "] the mesh is too large for its format; make it coarser.");
  return writer->GetOutputString();
}

std::string bytesOf(const std::string& format,
                    const std::vector<TriangleMesh>& parts,
                    const std::vector<Color>& colors) {
  const vtkNew<vtkPolyData> data = toPolyData(parts, colors); // a check for all formats
  if (format == ".vtp")
    return vtpBytes(data);
  if (format == ".ply")
    return plyBytes(parts, colors);
  return format == ".stl" ? stlBytes(parts) : objBytes(parts);
}

void write(const std::string& path,
           const std::vector<TriangleMesh>& parts,
           const std::vector<Color>& colors) {
  const std::string format = formatOf(path, ".ply");
  if (format != ".ply" && format != ".obj" && format != ".stl" && format != ".vtp")
    throw Exception("[" + WHO + "] " + path +
                    " has no ending of a mesh format; use .ply, .obj, .stl or .vtp.");
  std::string why;
  if (!writeFile(path, bytesOf(format, parts, colors), &why))
    throw Exception("[" + WHO + "] " + why + ".");
}

} // namespace

void writeMesh(const std::string& path, const TriangleMesh& mesh) {
  write(path, {mesh}, {});
}

void writeMesh(const std::string& path,
               const std::vector<TriangleMesh>& parts,
               const std::vector<Color>& colors) {
  if (!colors.empty() && colors.size() != parts.size())
    throw Exception("[" + WHO + "] " + std::to_string(parts.size()) + " parts have " +
                    std::to_string(colors.size()) +
                    " colours; give one per part or none.");
  std::vector<Color> used = colors;
  for (std::size_t i = used.size(); i < parts.size(); ++i)
    used.push_back(partColor(i));
  write(path, parts, used);
}

} // namespace pcl_sq
