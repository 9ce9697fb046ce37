// SPDX-License-Identifier: BSD-3-Clause
#include "observe_parts.h"

#include <algorithm>

namespace pcl_sq {

using namespace detail;

bool ViewOptions::isValid(std::string* why) const {
  const auto refuse = [why](const char* sentence) {
    if (why)
      *why = sentence;
    return false;
  };
  if (camera && !camera->isValid(why))
    return false;
  if (mask.cells.size() != std::size_t(mask.width) * std::size_t(mask.height))
    return refuse("the mask must hold width * height pixels");
  if (viewpoint && !viewpoint->allFinite())
    return refuse("the viewpoint must be finite");
  if (table &&
      (!(std::abs(table->normal.norm() - 1.0) < 1e-3) || !std::isfinite(table->offset)))
    return refuse("the table's normal must have length one and its offset be finite");
  if (!(mask_sigma > 0.0 && mask_sigma <= 20.0))
    return refuse("mask_sigma must lie in (0, 20]");
  if (!(mask_dilation >= 0.0 && mask_dilation <= 20.0))
    return refuse("mask_dilation must lie in [0, 20]");
  if (!(correlation >= 1.0 && correlation <= 100.0))
    return refuse("correlation must lie in [1, 100]");
  return true;
}

const char* toString(OutlineSource source) {
  switch (source) {
  case OutlineSource::NONE:
    return "none";
  case OutlineSource::MASK:
    return "mask";
  case OutlineSource::DEPTH:
    return "depth";
  case OutlineSource::POINTS:
    return "points";
  }
  return "unknown";
}

SupportEvidence ObservedObject::evidence(
    const std::vector<ContourPoint>& outline_points, int lines, bool on_table) const {
  SupportEvidence e;
  if (hasCamera()) {
    for (SilhouetteLine& line : silhouetteLines(outline_points, lines)) {
      line.offset -= outline_offset;
      e.silhouette.push_back(tangentPlane(camera, line, outline_sigma, depth));
    }
    e.dilation_sigma = outline_dilation * depth / std::sqrt(camera.fx * camera.fy);
    e.viewpoint = camera.center;
  }
  if (table) {
    e.up = table->normal;
    SupportPlane below;
    below.normal = -table->normal;
    below.offset = table->offset;
    below.sigma = std::max(table->sigma, 3e-4);
    (on_table ? e.tangents : e.limits).push_back(below);
  }
  return e;
}

bool observeObject(const CloudPoints& points,
                   int width,
                   int height,
                   const std::vector<int>& object,
                   const ViewOptions& view,
                   ObservedObject& observed,
                   std::string* why) {
  observed = {};
  const auto fail = [&](const std::string& sentence) {
    observed = {};
    if (why)
      *why = sentence;
    return false;
  };
  std::string reason;
  if (!view.isValid(&reason))
    return fail(reason);
  const bool organized = height > 1 && width > 1;
  const bool has_mask = !view.mask.cells.empty();
  if (has_mask && (view.mask.width != width || view.mask.height != height))
    return fail("the mask has " + std::to_string(view.mask.width) + " x " +
                std::to_string(view.mask.height) + " pixels, the cloud " +
                std::to_string(width) + " x " + std::to_string(height) +
                "; give the mask of the same image");
  Observation o{points, width, height, object, view, observed};
  if (organized) {
    if (view.camera)
      observed.camera = *view.camera;
    else if (!findIntrinsics(points, width, height, observed.camera)) {
      if (has_mask)
        return fail("the cloud is no pinhole image in its camera's frame, so that its "
                    "mask cannot be used; give the intrinsics or leave out the mask");
      observed.notes.push_back(
          "the cloud is an image of points, but not one from its camera's place, so "
          "its outline is not used; the camera's intrinsics or the cloud in the "
          "camera's frame would help");
      return observeBare(o, reason) || fail(reason);
    }
    return observeImage(o, reason) || fail(reason);
  }
  return observeBare(o, reason) || fail(reason);
}

} // namespace pcl_sq
