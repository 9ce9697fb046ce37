// SPDX-License-Identifier: BSD-3-Clause
#include "observe/observe_parts.h"
#include "sensor/camera_pose.h"
#include "tuning/observe_tuning.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

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
  if (others.cells.size() != std::size_t(others.width) * std::size_t(others.height))
    return refuse("the mask of others must hold width * height pixels");
  if (viewpoint && !viewpoint->allFinite())
    return refuse("the viewpoint must be finite");
  if (up && !(up->allFinite() && up->norm() > 1e-9))
    return refuse("the direction of up must be finite and not zero");
  if (table &&
      (!(std::abs(table->normal.norm() - 1.0) < 1e-3) || !std::isfinite(table->offset)))
    return refuse("the table's normal must have length one and its offset be finite");
  if (noise.size() > 0 && !(noise.minCoeff() > 0.0F && noise.allFinite()))
    return refuse("the points' noise must be finite and positive");
  if (!(mask_sigma > 0.0 && mask_sigma <= 20.0))
    return refuse("mask_sigma must lie in (0, 20]");
  if (!(mask_correlation >= 1.0 && mask_correlation <= 100.0))
    return refuse("mask_correlation must lie in [1, 100]");
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

namespace {

using namespace tuning::observe_object;

std::vector<ContourPoint> asOwn(std::vector<ContourPoint> contour) {
  for (ContourPoint& p : contour)
    p.own = true;
  return contour;
}

/** \brief Where the outline is not the object's own, at an occluder or the border of
 * the image, nobody knows how it goes on. A body reaches to there, for it is seen, and
 * ends about there unless evidence says more.
 * \param[in] outline of the object or of a piece of it */
void addHiddenEnds(const ObservedObject& object,
                   const TouchingLines& outline,
                   int lines,
                   ViewEvidence& evidence) {
  if (object.pixels.cells.empty())
    return;
  const bool all_own = std::all_of(object.contour.begin(),
                                   object.contour.end(),
                                   [](const ContourPoint& p) { return p.own; });
  if (all_own && !(object.table && object.hidden_below))
    return; // nothing of it is hidden
  const auto endOf = [&object](const SilhouetteLine& line) {
    TangentPlane end = tangentPlane(object.camera, line, 1.0, object.depth);
    end.sigma = HIDDEN_SIGMA * object.extent;
    return end;
  };
  const CellMask& mask = object.pixels;
  const auto atBorder = [&mask](const Eigen::Vector2d& p) {
    return p.x() < 1.0 || p.y() < 1.0 || p.x() > mask.width - 2.0 ||
           p.y() > mask.height - 2.0;
  };
  // a piece's other ends are its joints; of the image's border its whole side counts,
  // not its corners, or a foot would be drawn on beyond it that nobody has seen
  const double side = TOUCHES / std::sin(0.75 * 2.0 * M_PI / std::max(8, lines));
  const auto endsAt = [&](const SilhouetteLine& line) {
    const Eigen::Vector2d along(-line.direction.y(), line.direction.x());
    double low = 1e300, high = -1e300;
    for (const ContourPoint& p : object.contour)
      if (!p.own && object.outline == OutlineSource::MASK &&
          std::abs(line.direction.dot(p.pixel) - line.offset) <= TOUCHES) {
        low = std::min(low, along.dot(p.pixel));
        high = std::max(high, along.dot(p.pixel));
      }
    return high - low >= (atBorder(line.contact) ? side : 0.0);
  };
  const TouchingLines own = touchingLines(object.contour, lines);
  std::vector<SilhouetteLine> all = own.lines;
  // it stands on the table, however little of it is seen
  if (object.table && object.hidden_below) {
    std::vector<ContourPoint> with_feet = asOwn(object.contour);
    const Eigen::Index step = std::max<Eigen::Index>(1, object.points.cols() / FEET);
    for (Eigen::Index i = 0; i < object.points.cols(); i += step) {
      const Eigen::Vector3d p = object.points.col(i);
      ContourPoint foot;
      foot.pixel =
          object.camera.project(p - object.table->height(p) * object.table->normal);
      with_feet.push_back(foot);
    }
    all = silhouetteLines(with_feet, lines);
  }
  std::vector<TangentPlane> behind;
  const std::vector<SilhouetteLine>& pieces = outline.lines;
  for (const SilhouetteLine& line : all) {
    const auto reached =
        std::find_if(pieces.begin(), pieces.end(), [&](const SilhouetteLine& other) {
          return other.direction == line.direction && endsAt(other);
        });
    // a foot that nobody sees is beyond what is reached
    const bool is_seen = object.pixels(int(line.contact.x()), int(line.contact.y()));
    const bool reaches = is_seen && reached != pieces.end() && !outline.knows(line);
    if (reaches)
      evidence.tangents.push_back(endOf(*reached));
    if (own.knows(line) || (reaches && reached->offset == line.offset))
      continue;
    const bool hides = object.outline == OutlineSource::MASK && !atBorder(line.contact);
    (hides ? behind : evidence.limits).push_back(endOf(line));
  }
  // how far it goes on behind another is one thing that is not known, not one for each
  // line
  for (TangentPlane& end : behind) {
    end.sigma *= std::sqrt(double(behind.size()));
    evidence.limits.push_back(end);
  }
}

} // namespace

ViewEvidence ObservedObject::evidence(const std::vector<ContourPoint>& outline_points,
                                      int lines,
                                      bool on_table) const {
  ViewEvidence e;
  const TouchingLines touching = touchingLines(outline_points, lines);
  if (hasCamera()) {
    for (std::size_t i = 0; i < touching.lines.size(); ++i) {
      SilhouetteLine line = touching.lines[i];
      line.offset -= outline_offset;
      if (touching.known[i])
        e.silhouette.push_back(tangentPlane(camera, line, outline_sigma, depth));
    }
    e.dilation_sigma = outline_dilation * depth / std::sqrt(camera.fx * camera.fy);
    e.viewpoint = camera.center;
  }
  addHiddenEnds(*this, touching, lines, e);
  if (table) {
    e.up = table->normal;
    TangentPlane below;
    below.normal = -table->normal;
    below.offset = table->offset;
    below.sigma = std::max(table->sigma, 3e-4);
    (on_table ? e.tangents : e.limits).push_back(below);
  }
  return e;
}

bool detail::findImage(const CloudPoints& points,
                       int width,
                       int height,
                       const ViewOptions& view,
                       PinholeCamera& camera) {
  const bool found = findCamera(points, width, height, view.viewpoint, camera);
  if (!view.camera)
    return found;
  // intrinsics alone say nothing of the frame: where it is not the camera's own, the
  // cloud tells better
  const bool elsewhere = found && !CameraPose(camera).isIdentity() &&
                         CameraPose(*view.camera).isIdentity();
  if (!elsewhere)
    camera = *view.camera;
  return true;
}

void detail::noteOtherViewpoint(const CloudPoints& points,
                                const PinholeCamera& camera,
                                const ViewOptions& view,
                                std::vector<std::string>& notes) {
  if (!view.viewpoint)
    return;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (points.col(i).allFinite()) {
      sum += points.col(i).cast<double>();
      ++count;
    }
  const double distance = (sum / std::max(1, count) - camera.center).norm();
  if ((*view.viewpoint - camera.center).norm() < SAME * distance)
    return;
  std::ostringstream sentence;
  sentence
      << std::fixed << std::setprecision(3) << "the cloud is an image taken from ("
      << camera.center.x() << ", " << camera.center.y() << ", " << camera.center.z()
      << ") m, which is not the viewpoint that was given; that of the image counts";
  notes.push_back(sentence.str());
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
  if (view.noise.size() > 0 && view.noise.size() != points.cols())
    return fail("the noise is that of " + std::to_string(view.noise.size()) +
                " points, the cloud has " + std::to_string(points.cols()) +
                "; give one number for each point");
  const bool organized = height > 1 && width > 1;
  const bool has_mask = !view.mask.cells.empty();
  if (has_mask && (view.mask.width != width || view.mask.height != height))
    return fail("the mask has " + std::to_string(view.mask.width) + " x " +
                std::to_string(view.mask.height) + " pixels, the cloud " +
                std::to_string(width) + " x " + std::to_string(height) +
                "; give the mask of the same image");
  if (!view.others.cells.empty() &&
      (view.others.width != width || view.others.height != height))
    return fail("the mask of others has another size than the cloud; give the mask of "
                "the same image");
  PinholeCamera camera;
  const bool complete = view.coverage == Coverage::COMPLETE;
  if (!organized || complete || !findImage(points, width, height, view, camera)) {
    if (organized && has_mask)
      return fail(
          "the cloud is no pinhole image, so that its mask cannot be used; give "
          "the intrinsics or leave out the mask");
    if (organized && !complete)
      observed.notes.push_back(
          "the cloud is no image of a camera, although it has rows, so its outline is "
          "not used; give the camera's intrinsics if it is one");
    Observation o{points, width, height, object, view, observed};
    return observeBare(o, reason) || fail(reason);
  }
  observed.viewpoint_known = true;
  noteOtherViewpoint(points, camera, view, observed.notes);
  const CameraPose pose(camera);
  observed.camera = camera;
  if (pose.isIdentity()) {
    Observation o{points, width, height, object, view, observed};
    return observeImage(o, reason) || fail(reason);
  }
  observed.camera.center.setZero();
  observed.camera.rotation.setIdentity();
  const Eigen::Matrix3Xf moved = pose.toCamera(points);
  const ViewOptions moved_view = pose.toCamera(view);
  Observation o{moved, width, height, object, moved_view, observed};
  if (!observeImage(o, reason))
    return fail(reason);
  pose.toCloud(observed, points);
  return true;
}

} // namespace pcl_sq
