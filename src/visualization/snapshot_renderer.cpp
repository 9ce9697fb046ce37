// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/visualization/snapshot_renderer.h"

#include "pcl_sq/exception.h"
#include "pcl_sq/file_io.h"
#include "visualization/drawing/overlay.h"
#include "visualization/drawing/scene.h"
#include "visualization/files/png_file.h"
#include "visualization/frame_renderer.h"

#include <cmath>
#include <cstdio>

namespace pcl_sq {
namespace {

const std::string SAVE = "pcl_sq::SnapshotRenderer::save";

/** \brief Focus of a scene that can be shown. */
Eigen::Matrix3Xd checkedFocus(const SnapshotScene& scene) {
  std::string why;
  if (!scene.options.isValid(&why))
    throw Exception("[pcl_sq::SnapshotRenderer::render] " + why + ".");
  Eigen::Matrix3Xd focus = scene.focus();
  if (focus.cols() == 0)
    throw Exception(
        "[pcl_sq::SnapshotRenderer::render] there is nothing to show; add a "
        "model or a cloud with finite points.");
  return focus;
}

void requireFinite(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                   const char* method) {
  if (!points.allFinite())
    throw Exception(std::string("[pcl_sq::SnapshotRenderer::") + method +
                    "] a coordinate is not finite; leave such points out.");
}

/** \brief out.png gives out_000.png, out_001.png ... */
std::vector<std::string> numberedNames(const std::string& path, int count) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) {
    char number[24];
    std::snprintf(number, sizeof number, "_%03d.png", i);
    names.push_back(path.substr(0, path.size() - 4) + number);
  }
  return names;
}

ViewCamera stillCamera(const SnapshotScene& scene, const Eigen::Matrix3Xd& focus) {
  const SnapshotOptions& o = scene.options;
  return {focus, o.view, o.up, o.width, o.height, OverlayLayout(scene).margins};
}

} // namespace

SnapshotRenderer::SnapshotRenderer(const SnapshotOptions& options)
    : scene_(std::make_unique<SnapshotScene>()) {
  scene_->options = options;
}

SnapshotRenderer::~SnapshotRenderer() = default;
SnapshotRenderer::SnapshotRenderer(SnapshotRenderer&&) noexcept = default;
SnapshotRenderer& SnapshotRenderer::operator=(SnapshotRenderer&&) noexcept = default;

void SnapshotRenderer::setOptions(const SnapshotOptions& options) {
  scene_->options = options;
}

const SnapshotOptions& SnapshotRenderer::getOptions() const {
  return scene_->options;
}

void SnapshotRenderer::addCloud(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                                const Colors& colors) {
  if (colors.cols() != 0 && colors.cols() != points.cols())
    throw Exception("[pcl_sq::SnapshotRenderer::addCloud] " +
                    std::to_string(points.cols()) + " points have " +
                    std::to_string(colors.cols()) +
                    " colours; give one per point or none.");
  SnapshotScene::Cloud cloud;
  cloud.points.resize(3, points.cols());
  cloud.colors.resize(3, colors.cols());
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (!points.col(i).allFinite())
      continue;
    cloud.points.col(kept) = points.col(i);
    if (colors.cols() != 0)
      cloud.colors.col(kept) = colors.col(i);
    ++kept;
  }
  cloud.points.conservativeResize(3, kept);
  if (colors.cols() != 0)
    cloud.colors.conservativeResize(3, kept);
  scene_->clouds.push_back(std::move(cloud));
}

void SnapshotRenderer::addModel(const MultiSuperquadric& model) {
  std::string why;
  for (const Superquadric& part : model.parts)
    if (!part.isValid(&why))
      throw Exception(
          "[pcl_sq::SnapshotRenderer::addModel] a part is no superquadric: " + why +
          "; repair the model.");
  scene_->model.parts.insert(
      scene_->model.parts.end(), model.parts.begin(), model.parts.end());
}

void SnapshotRenderer::addMesh(const TriangleMesh& mesh, Color color, double opacity) {
  for (const Eigen::Vector3d& v : mesh.vertices)
    requireFinite(v, "addMesh");
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t index : triangle)
      if (index >= mesh.vertices.size())
        throw Exception("[pcl_sq::SnapshotRenderer::addMesh] a triangle's vertex does "
                        "not exist; repair the mesh.");
  scene_->surfaces.push_back({mesh, color, opacity});
}

void SnapshotRenderer::addLines(const Eigen::Ref<const Eigen::Matrix3Xd>& ends,
                                Color color,
                                double width) {
  requireFinite(ends, "addLines");
  if (ends.cols() % 2 != 0)
    throw Exception(
        "[pcl_sq::SnapshotRenderer::addLines] the last segment has one end; "
        "give two columns per segment.");
  scene_->segments.push_back({ends, color, width});
}

void SnapshotRenderer::addBoxes(const std::vector<RoiBox>& boxes,
                                Color color,
                                double width) {
  Eigen::Matrix3Xd ends(3, 24 * static_cast<Eigen::Index>(boxes.size()));
  Eigen::Index column = 0;
  for (const RoiBox& box : boxes) {
    const auto corner = [&box](int bits) {
      return Eigen::Vector3d((bits & 1 ? box.max : box.min).x(),
                             (bits & 2 ? box.max : box.min).y(),
                             (bits & 4 ? box.max : box.min).z());
    };
    for (int from = 0; from < 8; ++from)
      for (const int bit : {1, 2, 4})
        if ((from & bit) == 0) {
          ends.col(column++) = corner(from);
          ends.col(column++) = corner(from | bit);
        }
  }
  addLines(ends, color, width);
}

void SnapshotRenderer::addPoints(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                                 Color color,
                                 double size) {
  requireFinite(points, "addPoints");
  scene_->markers.push_back({points, color, size});
}

void SnapshotRenderer::clear() {
  const SnapshotOptions options = scene_->options;
  *scene_ = SnapshotScene();
  scene_->options = options;
}

ViewCamera SnapshotRenderer::camera() const {
  return stillCamera(*scene_, checkedFocus(*scene_));
}

SnapshotImage SnapshotRenderer::render() const {
  const Eigen::Matrix3Xd focus = checkedFocus(*scene_);
  const ViewCamera camera = stillCamera(*scene_, focus);
  return vtkPart("pcl_sq::SnapshotRenderer::render")
      .makeRenderer(camera.width(), camera.height())
      ->render(*scene_, focus, camera);
}

void SnapshotRenderer::save(const std::string& path) const {
  // before the work: a bad name must not cost a rendering
  checkPngPath(path, SAVE);
  writePng(path, render(), SAVE);
}

std::vector<std::string> SnapshotRenderer::saveTurntable(
    const std::string& path,
    int count,
    const std::function<void(std::size_t)>& progress) const {
  if (count < 1 || count > 1000)
    throw Exception("[pcl_sq::SnapshotRenderer::saveTurntable] the number of pictures "
                    "must lie in [1, 1000].");
  if (extensionOf(path) != ".png")
    throw Exception("[" + SAVE + "] '" + path +
                    "' does not end in .png; the pictures are numbered in front of "
                    "that ending.");
  std::vector<std::string> names = numberedNames(path, count);
  for (const std::string& name : names)
    checkPngPath(name, SAVE);
  const Eigen::Matrix3Xd focus = checkedFocus(*scene_);
  const SnapshotOptions& o = scene_->options;
  std::unique_ptr<FrameRenderer> renderer;
  for (int i = 0; i < count; ++i) {
    const ViewCamera camera = ViewCamera::turntable(focus,
                                                    o.view,
                                                    o.up,
                                                    o.width,
                                                    o.height,
                                                    OverlayLayout(*scene_).margins,
                                                    2.0 * M_PI * i / count);
    if (!renderer)
      renderer = vtkPart(SAVE).makeRenderer(o.width, o.height);
    const auto k = static_cast<std::size_t>(i);
    writePng(names[k], renderer->render(*scene_, focus, camera), SAVE);
    if (progress)
      progress(k + 1);
  }
  return names;
}

} // namespace pcl_sq
