// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/drawing/actors.h"

#include "pcl_sq/visibility.h"
#include "visualization/display/display_surface.h"
#include "visualization/drawing/cloud_style.h"
#include "visualization/drawing/ink.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace pcl_sq {
namespace {

/// Outlines are drawn this far in front of their surface, in sizes of the object.
constexpr double OUTLINE_LIFT = 0.003;
/// How far the side that the sensor did not see fades into the background, 0 to 1.
constexpr double UNSEEN = 0.65;

void setColor(vtkProperty* property, Color color) {
  property->SetColor(color.r / 255.0, color.g / 255.0, color.b / 255.0);
}

vtkNew<vtkActor> makeActor(vtkPolyData* data) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  return actor;
}

vtkNew<vtkCellArray>
makeTriangles(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  vtkNew<vtkCellArray> cells;
  for (const auto& t : triangles)
    cells->InsertNextCell({static_cast<vtkIdType>(t[0]),
                           static_cast<vtkIdType>(t[1]),
                           static_cast<vtkIdType>(t[2])});
  return cells;
}

/** \brief A part's colour for each vertex, lighter where the sensor could not see. */
vtkNew<vtkUnsignedCharArray> sensorColors(const SnapshotScene& scene,
                                          const DisplaySurface& surface,
                                          std::size_t index,
                                          const Eigen::Vector3d& sensor) {
  const Color color = partColor(index);
  const Color pale = mix(color, scene.options.background, UNSEEN);
  const double slack = 0.01 * scene.model.parts[index].semi_axes.minCoeff();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (const Eigen::Vector3d& v : surface.vertices) {
    const Color c = isHidden(scene.model, v, sensor, slack) ? pale : color;
    colors->InsertNextTypedTuple(std::array<unsigned char, 3>{c.r, c.g, c.b}.data());
  }
  return colors;
}

} // namespace

Stage::Stage(vtkRenderer* renderer,
             const ViewCamera& camera,
             const Eigen::Matrix3Xd& focus,
             double zoom)
    : renderer_(renderer), camera_(camera), zoom_(zoom) {
  box_ = {focus.rowwise().minCoeff().eval(), focus.rowwise().maxCoeff().eval()};
  origin_ = box_.center();
  const double size = box_.sizes().norm();
  scale_ = size > 0.0 ? size : 0.01;
}

void Stage::add(const SnapshotScene& scene) {
  addClouds(scene);
  for (std::size_t i = 0; i < scene.model.parts.size(); ++i)
    addPart(scene, i);
  for (const auto& surface : scene.surfaces)
    addSurface(surface);
  for (const auto& s : scene.segments)
    addSegments(s.ends, s.color, s.width);
  for (const auto& markers : scene.markers)
    addMarkers(markers);
  placeLights();
  placeCamera();
}

void Stage::placeCamera() {
  vtkCamera* camera = renderer_->GetActiveCamera();
  const Eigen::Vector3d eye = toStage(camera_.position());
  const Eigen::Vector3d ahead = eye + camera_.forward();
  camera->SetPosition(eye.x(), eye.y(), eye.z());
  camera->SetFocalPoint(ahead.x(), ahead.y(), ahead.z());
  camera->SetViewUp(camera_.up().x(), camera_.up().y(), camera_.up().z());
  const double half_height = 0.5 * camera_.height();
  if (camera_.perspective()) {
    camera->SetViewAngle(2.0 * std::atan(half_height / camera_.focalLength()) * 180.0 /
                         M_PI);
    // the optical axis passes beside the window that is cut out of the sensor's image
    const double half_width = 0.5 * camera_.width();
    camera->SetWindowCenter(1.0 - camera_.principalPoint().x() / half_width,
                            camera_.principalPoint().y() / half_height - 1.0);
  } else {
    camera->ParallelProjectionOn();
    camera->SetParallelScale(half_height / camera_.pixelsPerMeter() / scale_);
  }
  renderer_->ResetCameraClippingRange();
}

void Stage::placeLights() {
  renderer_->RemoveAllLights();
  renderer_->AutomaticLightCreationOff();
  // camera's axes: x right, y up, z towards the eye
  const auto light = [this](double x, double y, double z, double intensity) {
    vtkNew<vtkLight> lamp;
    lamp->SetLightTypeToCameraLight();
    lamp->SetPosition(x, y, z);
    lamp->SetFocalPoint(0, 0, 0);
    lamp->SetIntensity(intensity);
    renderer_->AddLight(lamp);
  };
  light(-0.6, 0.9, 1.0, 0.75);
  light(0.9, 0.2, 0.8, 0.30);
}

void Stage::addClouds(const SnapshotScene& scene) {
  const StyledPoints styled = styleClouds(scene, camera_, box_);
  if (styled.points.empty())
    return;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (std::size_t i = 0; i < styled.points.size(); ++i) {
    const Eigen::Vector3d p = toStage(styled.points[i]);
    vertices->InsertNextCell({points->InsertNextPoint(p.data())});
    const Color c = styled.colors[i];
    colors->InsertNextTypedTuple(std::array<unsigned char, 3>{c.r, c.g, c.b}.data());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(vertices);
  data->GetPointData()->SetScalars(colors);
  const auto actor = makeActor(data);
  actor->GetProperty()->SetPointSize(static_cast<float>(zoom_ * styled.size));
  actor->GetProperty()->RenderPointsAsSpheresOn();
  actor->GetProperty()->LightingOff();
  renderer_->AddActor(actor);
}

void Stage::addPart(const SnapshotScene& scene, std::size_t index) {
  const SnapshotOptions& options = scene.options;
  const Color color = partColor(index);
  const DisplaySurface surface = displaySurface(scene.model.parts[index]);
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  std::vector<Eigen::Vector3d> to_eye;
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    points->InsertNextPoint(toStage(surface.vertices[i]).data());
    normals->InsertNextTuple(surface.normals[i].data());
    to_eye.push_back(camera_.toEye(surface.vertices[i]));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(makeTriangles(surface.triangles));
  data->GetPointData()->SetNormals(normals);
  if (options.sensor)
    data->GetPointData()->SetScalars(
        sensorColors(scene, surface, index, *options.sensor));
  const auto actor = makeActor(data);
  vtkProperty* property = actor->GetProperty();
  setColor(property, color);
  property->SetOpacity(options.opacity);
  property->SetAmbient(0.5);
  property->SetDiffuse(0.5);
  property->SetSpecular(0.15);
  property->SetSpecularPower(40);
  // a convex body shows its front only: one even layer of colour
  property->BackfaceCullingOn();
  renderer_->AddActor(actor);

  // the outline strong, edges finer, those of the far side only hinted at
  const double unit =
      std::max(0.6, std::min(camera_.width(), camera_.height()) / 960.0);
  const Color ink = strongerOn(options.background, color);
  std::vector<Eigen::Vector3d> near_edges, far_edges;
  for (const auto& edge : surface.edges)
    for (std::size_t i = 0; i + 1 < edge.size(); ++i) {
      const std::uint32_t a = edge[i], b = edge[i + 1];
      const bool near = surface.normals[a].dot(to_eye[a]) > 0.0 &&
                        surface.normals[b].dot(to_eye[b]) > 0.0;
      auto& ends = near ? near_edges : far_edges;
      ends.push_back(surface.vertices[a]);
      ends.push_back(surface.vertices[b]);
    }
  addSegments(lifted(outline(surface, to_eye)), ink, 2.2 * unit);
  addSegments(lifted(near_edges), ink, 1.4 * unit);
  addSegments(lifted(far_edges), mix(ink, color, 0.5), 1.0 * unit);
}

/** \brief Points a little closer to the eye than the surface they lie on. */
Eigen::Matrix3Xd Stage::lifted(const std::vector<Eigen::Vector3d>& points) const {
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    result.col(static_cast<Eigen::Index>(i)) =
        points[i] + OUTLINE_LIFT * scale_ * camera_.toEye(points[i]).normalized();
  return result;
}

void Stage::addSurface(const SnapshotScene::Surface& surface) {
  vtkNew<vtkPoints> points;
  for (const Eigen::Vector3d& v : surface.mesh.vertices)
    points->InsertNextPoint(toStage(v).data());
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(makeTriangles(surface.mesh.triangles));
  const auto actor = makeActor(data);
  setColor(actor->GetProperty(), surface.color);
  actor->GetProperty()->SetOpacity(surface.opacity);
  actor->GetProperty()->SetAmbient(0.2);
  actor->GetProperty()->SetDiffuse(0.8);
  actor->GetProperty()->SetInterpolationToFlat();
  renderer_->AddActor(actor);
}

void Stage::addSegments(const Eigen::Matrix3Xd& ends, Color color, double width) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines, joints;
  for (Eigen::Index i = 0; i + 1 < ends.cols(); i += 2) {
    const vtkIdType first = points->InsertNextPoint(toStage(ends.col(i)).data());
    points->InsertNextPoint(toStage(ends.col(i + 1)).data());
    lines->InsertNextCell({first, first + 1});
    joints->InsertNextCell({first});
    joints->InsertNextCell({first + 1});
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  data->SetVerts(joints); // round ends, or a bend of wide lines would gape
  const auto actor = makeActor(data);
  setColor(actor->GetProperty(), color);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(static_cast<float>(zoom_ * width));
  actor->GetProperty()->SetPointSize(static_cast<float>(zoom_ * width));
  actor->GetProperty()->RenderPointsAsSpheresOn();
  renderer_->AddActor(actor);
}

void Stage::addMarkers(const SnapshotScene::Markers& markers) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  for (Eigen::Index i = 0; i < markers.points.cols(); ++i)
    vertices->InsertNextCell(
        {points->InsertNextPoint(toStage(markers.points.col(i)).data())});
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(vertices);
  const auto actor = makeActor(data);
  setColor(actor->GetProperty(), markers.color);
  actor->GetProperty()->SetPointSize(static_cast<float>(zoom_ * markers.size));
  actor->GetProperty()->SetAmbient(0.5);
  actor->GetProperty()->SetDiffuse(0.6);
  actor->GetProperty()->RenderPointsAsSpheresOn();
  renderer_->AddActor(actor);
}

} // namespace pcl_sq
