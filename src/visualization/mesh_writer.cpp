// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/visualization/mesh_writer.h"

#include "pcl_sq/exception.h"
#include "visualization/output_file.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkOBJWriter.h>
#include <vtkPLYWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSTLWriter.h>
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

/** \brief Runs a writer that is set up but for its file. */
template <class Writer>
void run(Writer* writer, vtkPolyData* data, const std::string& path) {
  OutputFile file(path, WHO);
  writer->SetInputData(data);
  writer->SetFileName(file.temporaryPath().c_str());
  if (writer->Write() == 0 || writer->GetErrorCode() != 0)
    throw Exception("[" + WHO + "] " + path +
                    " could not be written to its end; is the disk full?");
  file.commit();
}

void write(const std::string& path,
           const std::vector<TriangleMesh>& parts,
           const std::vector<Color>& colors) {
  const std::string extension = lowerExtension(path);
  if (extension == ".ply") {
    vtkNew<vtkPLYWriter> writer;
    writer->SetFileTypeToBinary();
    if (!colors.empty())
      writer->SetArrayName("RGB");
    run(writer.Get(), toPolyData(parts, colors), path);
  } else if (extension == ".stl") {
    vtkNew<vtkSTLWriter> writer;
    writer->SetFileTypeToBinary();
    run(writer.Get(), toPolyData(parts, {}), path);
  } else if (extension == ".obj") {
    vtkNew<vtkOBJWriter> writer;
    run(writer.Get(), toPolyData(parts, {}), path);
  } else if (extension == ".vtp") {
    vtkNew<vtkXMLPolyDataWriter> writer;
    run(writer.Get(), toPolyData(parts, colors), path);
  } else {
    throw Exception("[" + WHO + "] " + path +
                    " has no ending of a mesh format; use .ply, .obj, .stl or .vtp.");
  }
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
