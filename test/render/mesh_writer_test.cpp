// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/visualization/mesh_writer.h"

#include "folder.h"
#include "pcl_sq/exception.h"
#include "random_superquadric.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>

using namespace pcl_sq;

namespace {

template <class Reader>
vtkSmartPointer<vtkPolyData> readWith(const std::string& path) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkPolyData> readMesh(const std::string& path) {
  const std::string ending = path.substr(path.size() - 4);
  if (ending == ".ply")
    return readWith<vtkPLYReader>(path);
  if (ending == ".obj")
    return readWith<vtkOBJReader>(path);
  if (ending == ".stl")
    return readWith<vtkSTLReader>(path);
  return readWith<vtkXMLPolyDataReader>(path);
}

/** \brief Enclosed volume: tells the triangles, their corners and their orientation. */
double volumeOf(vtkPolyData* data) {
  double six_volumes = 0.0;
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
    vtkNew<vtkIdList> ids;
    data->GetCellPoints(i, ids);
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k)
      data->GetPoint(ids->GetId(k), corners.col(k).data());
    six_volumes += corners.determinant();
  }
  return six_volumes / 6.0;
}

std::vector<TriangleMesh> twoParts() {
  test::Random random(5);
  return {meshSuperquadric(random.superquadric(), 8),
          meshSuperquadric(random.superquadric(), 8)};
}

const std::vector<std::string> ENDINGS = {".ply", ".obj", ".stl", ".vtp"};

std::string sentenceOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

} // namespace

TEST(MeshWriter, EveryFormatHoldsTheWholeClosedSurface) {
  const test::Folder folder;
  test::Random random(4);
  const Superquadric s = random.superquadric();
  const TriangleMesh mesh = meshSuperquadric(s, 16);
  double volume = 0.0;
  for (const auto& t : mesh.triangles)
    volume +=
        mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6;
  for (const std::string& ending : ENDINGS) {
    const std::string path = folder / "mesh" + ending;
    writeMesh(path, mesh);
    const auto read = readMesh(path);
    EXPECT_EQ(read->GetNumberOfCells(), static_cast<vtkIdType>(mesh.triangles.size()))
        << ending;
    EXPECT_NEAR(volumeOf(read), volume, 1e-3 * volume) << ending;
  }
  EXPECT_EQ(folder.files(), 4u) << "temporary files are left behind";
}

TEST(MeshWriter, PartsCarryTheirColoursAndNumbers) {
  const test::Folder folder;
  const std::vector<TriangleMesh> parts = twoParts();
  for (const char* ending : {".ply", ".vtp"}) {
    const std::string path = folder / std::string("parts") + ending;
    writeMesh(path, parts);
    const auto read = readMesh(path);
    vtkDataArray* colors = read->GetPointData()->GetScalars();
    ASSERT_NE(colors, nullptr) << ending;
    const auto first = static_cast<vtkIdType>(0);
    const auto last = read->GetNumberOfPoints() - 1;
    EXPECT_EQ(colors->GetComponent(first, 0), partColor(0).r) << ending;
    EXPECT_EQ(colors->GetComponent(first, 2), partColor(0).b) << ending;
    EXPECT_EQ(colors->GetComponent(last, 0), partColor(1).r) << ending;
    EXPECT_EQ(colors->GetComponent(last, 2), partColor(1).b) << ending;
  }
  const auto vtp = readMesh(folder / "parts.vtp");
  vtkDataArray* numbers = vtp->GetCellData()->GetArray("part");
  ASSERT_NE(numbers, nullptr);
  EXPECT_EQ(numbers->GetComponent(0, 0), 1);
  EXPECT_EQ(numbers->GetComponent(vtp->GetNumberOfCells() - 1, 0), 2);
}

TEST(MeshWriter, PartsAreJoinedInFormatsWithoutColours) {
  const test::Folder folder;
  const std::vector<TriangleMesh> parts = twoParts();
  for (const char* ending : {".obj", ".stl"}) {
    const std::string path = folder / std::string("parts") + ending;
    writeMesh(path, parts, {{1, 2, 3}, {4, 5, 6}});
    EXPECT_EQ(static_cast<std::size_t>(readMesh(path)->GetNumberOfCells()),
              parts[0].triangles.size() + parts[1].triangles.size());
  }
}

TEST(MeshWriter, EndingsMayBeUpperCase) {
  const test::Folder folder;
  writeMesh(folder / "MESH.STL", twoParts().front());
  EXPECT_GT(readWith<vtkSTLReader>(folder / "MESH.STL")->GetNumberOfCells(), 0);
}

TEST(MeshWriter, UnknownEndingsAreAnErrorThatNamesTheFour) {
  const test::Folder folder;
  for (const std::string name : {"mesh.dae", "mesh", "mesh.", "ply"}) {
    const std::string sentence =
        sentenceOf([&] { writeMesh(folder / name, twoParts().front()); });
    for (const std::string& ending : ENDINGS)
      EXPECT_NE(sentence.find(ending), std::string::npos) << sentence;
  }
  EXPECT_EQ(folder.files(), 0u);
}

TEST(MeshWriter, WhatCannotBeWrittenIsAnErrorAndLeavesNothing) {
  const test::Folder folder;
  const TriangleMesh mesh = twoParts().front();
  EXPECT_THROW(writeMesh(folder / "no/such/folder/mesh.ply", mesh), Exception);
  EXPECT_THROW(writeMesh(folder / "empty.ply", TriangleMesh()), Exception);
  TriangleMesh broken = mesh;
  broken.triangles.front()[1] = static_cast<std::uint32_t>(mesh.vertices.size());
  EXPECT_THROW(writeMesh(folder / "broken.ply", broken), Exception);
  TriangleMesh infinite = mesh;
  infinite.vertices.front().x() = INFINITY;
  EXPECT_THROW(writeMesh(folder / "infinite.ply", infinite), Exception);
  EXPECT_THROW(writeMesh(folder / "colours.ply", twoParts(), {{1, 2, 3}}), Exception);
  EXPECT_EQ(folder.files(), 0u);
}

TEST(MeshWriter, AFailureKeepsTheFileThatWasThere) {
  const test::Folder folder;
  const std::string path = folder / "mesh.ply";
  std::ofstream(path) << "precious";
  EXPECT_THROW(writeMesh(path, TriangleMesh()), Exception);
  std::string text;
  std::ifstream(path) >> text;
  EXPECT_EQ(text, "precious");
}
