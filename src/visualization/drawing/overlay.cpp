// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/drawing/overlay.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <cmath>
#include <vector>

namespace pcl_sq {

void Overlay::polygon(const Eigen::Matrix2Xd& corners, Color color, double opacity) {
  vtkNew<vtkPoints> points;
  std::vector<vtkIdType> ids;
  for (Eigen::Index i = 0; i < corners.cols(); ++i)
    ids.push_back(points->InsertNextPoint(
        zoom_ * corners(0, i), zoom_ * (height_ - corners(1, i)), 0.0));
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color.r / 255.0, color.g / 255.0, color.b / 255.0);
  actor->GetProperty()->SetOpacity(opacity);
  renderer_->AddActor2D(actor);
}

void Overlay::rectangle(double x, double y, double w, double h, Color color, double o) {
  Eigen::Matrix2Xd corners(2, 4);
  corners << x, x + w, x + w, x, y, y, y + h, y + h;
  polygon(corners, color, o);
}

void Overlay::stroke(const Eigen::Vector2d& a,
                     const Eigen::Vector2d& b,
                     double width,
                     Color color) {
  const Eigen::Vector2d along = b - a;
  if (along.norm() < 1e-6)
    return;
  const Eigen::Vector2d side =
      0.5 * width * Eigen::Vector2d(-along.y(), along.x()).normalized();
  Eigen::Matrix2Xd corners(2, 4);
  corners << a - side, b - side, b + side, a + side;
  polygon(corners, color);
}

double Overlay::text(const std::string& utf8,
                     double x,
                     double y,
                     double size,
                     Color color,
                     Align align,
                     bool bold) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(utf8.c_str());
  vtkTextProperty* property = actor->GetTextProperty();
  property->SetFontFamilyToArial();
  property->SetFontSize(static_cast<int>(std::lround(zoom_ * size)));
  property->SetColor(color.r / 255.0, color.g / 255.0, color.b / 255.0);
  property->SetBold(bold ? 1 : 0);
  property->SetVerticalJustificationToCentered();
  if (align == Align::CENTER)
    property->SetJustificationToCentered();
  else if (align == Align::RIGHT)
    property->SetJustificationToRight();
  actor->SetPosition(zoom_ * x, zoom_ * (height_ - y));
  renderer_->AddActor2D(actor);
  double extent[2] = {0.0, 0.0};
  actor->GetSize(renderer_, extent);
  return extent[0] / zoom_;
}

} // namespace pcl_sq
