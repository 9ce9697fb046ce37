// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/depth_histogram.h"
#include "pcl_sq/object_surface_estimation.h"
#include "pcl_sq/stereo/object_segmenter.h"
#include "pcl_sq/stereo/stereo_reprojector.h"

#include <array>
#include <optional>

namespace pcl_sq {

/** \brief Where the object is in the rectified left image; at most one of these. */
struct StereoHint {
  CellRect box;          ///< drawn around it; empty: none
  bool box_only = false; ///< whether no outline is looked for in the box
  std::optional<std::array<int, 2>> click; ///< a pixel of it: x, y
  std::optional<std::array<int, 3>> color; ///< its colour: red, green, blue, 0 to 255
  cv::Mat mask; ///< CV_8U, its pixels not 0, of the image's size; empty: none
  /** \brief Whether there is none: the largest thing on the table is looked for. */
  bool empty() const { return box.empty() && !click && !color && mask.empty(); }
};

/** \brief Settings of StereoPipeline; as they stand here, the best mode. */
struct PCL_SQ_EXPORTS StereoPipelineOptions {
  StereoOptions stereo;
  StereoHint hint;
  SegmentMethod segmentation = SegmentMethod::GRABCUT;
  bool border_filter = false; ///< see TextureBorderFilter
  /** \brief How the model is made; what a pair tells of the view is filled in. */
  EstimationOptions estimation;
  unsigned int threads = 0;  ///< for the fits, 0: all cores
  ProgressCallback progress; ///< is told the stages (optional)

  StereoPipelineOptions() { stereo.matcher = StereoMatcher::SGBM; }
};

/** \brief The object's points and where they come from. */
struct StereoView {
  StereoResult stereo;
  Segment segment; ///< its mask is empty if only a box is known
  CellRect rect;   ///< 2D query
  DepthHistogram histogram;
  RoiBox region;       ///< 3D query [m]
  pcl::Indices object; ///< points of the object in the stereo cloud
  /** \brief Points under the mask far from the region: false matches along the outline,
   * with the depth of what is behind. */
  pcl::Indices strays;
  std::vector<std::string> notes;                         ///< what was assumed
  std::vector<std::pair<std::string, double>> timings_ms; ///< stage, [ms], in order
};

/** \brief What a pair of images gave. */
struct StereoObject {
  StereoView view;
  MultiSuperquadric model; ///< in the left rectified camera's frame [m]
  EstimationReport report;
  std::string failure; ///< why there is no model, a sentence; empty on success
};

/** \brief From pairs of images to models, one after the other: the paper's whole chain.
 *
 * Rectifying maps are made once. Where frames follow each other (setFollowing()) only
 * the surroundings of the last outline are matched, over the last depths, and the
 * outline is cut along the last one; a frame that does not fit the last one is looked
 * at anew, as a single pair is. \code StereoPipeline
 * pipeline(StereoCalibration::load({"calib.yml"})); pipeline.setFollowing(true);
 * StereoObject result;
 * while (camera.grab(left, right))
 *   if (pipeline.process(left, right, result))
 *     use(result.model);
 * \endcode
 * \ingroup pcl_sq */
class PCL_SQ_EXPORTS StereoPipeline {
public:
  explicit StereoPipeline(StereoCalibration calibration = {})
      : reprojector_(std::move(calibration)) {}

  /** \brief Sets the options and forgets the last frame; invalid ones are refused with
   * a message. */
  void setOptions(const StereoPipelineOptions& options);
  const StereoPipelineOptions& getOptions() const { return options_; }
  const StereoCalibration& getCalibration() const {
    return reprojector_.getCalibration();
  }

  /** \brief Whether each frame shows the scene of the last one, a moment later. A hint
   * is then for the first frame. */
  void setFollowing(bool following) { following_ = following; }
  bool getFollowing() const { return following_; }
  /** \brief Forgets the last frame: the next one shows something else. */
  void reset() { last_.reset(); }

  /** \brief The object's model. \param[in] left, right 8-bit images of one size
   * \return false if there is none, with StereoObject::failure and a PCL_WARN */
  [[nodiscard]] bool
  process(const cv::Mat& left, const cv::Mat& right, StereoObject& result);

  /** \brief From the images to the cloud alone; there is no object yet.
   * \throws pcl_sq::Exception as StereoReprojector::compute() */
  StereoView see(const cv::Mat& left, const cv::Mat& right);
  /** \brief From the images to the object's points.
   * \throws pcl_sq::Exception where there are none, with what to do */
  StereoView look(const cv::Mat& left, const cv::Mat& right);
  /** \brief The same for a view without its object, of see() or reprojectDepth(). */
  StereoView look(StereoResult&& scene);

private:
  /** \brief What the next frame can start from. */
  struct LastFrame {
    cv::Mat mask;                            ///< of the whole image
    cv::Mat picture;                         ///< grey, the mask's box
    double min_depth = 0.0, max_depth = 0.0; ///< [m]
  };

  /** \brief As see(), but only the object's surroundings in full detail. \return
   * whether that was worth it */
  bool seeClosely(const cv::Mat& left, const cv::Mat& right, StereoView& view);
  bool followPair(const cv::Mat& left, const cv::Mat& right, StereoView& view);
  /** \brief The last outline, cut anew. \return whether it is the same thing's */
  bool followMask(StereoView& view) const;
  void finish(StereoView& view);
  void remember(const StereoView& view);

  StereoReprojector reprojector_;
  StereoPipelineOptions options_;
  bool following_ = false;
  std::optional<LastFrame> last_;
};

/** \brief Tells ViewOptions what a pair's view holds: camera, noise, outline.
 * \param[in] painted whether the outline is a painted mask's, which is sharper than
 * what colours and depth find */
PCL_SQ_EXPORTS void
tellView(const StereoView& view, bool painted, ViewOptions& options);

/** \brief The pair's own noise as that of its points: Z^2 / (f b) a pixel. */
PCL_SQ_EXPORTS void tellNoise(const StereoResult& stereo, ViewOptions& options);

/** \brief Why a model of the best mode is not to be trusted, a sentence, or "": it
 * fills but a piece of the box that was drawn, is a piece of a flat surface that goes
 * on, its points lie farther off than a hand makes up for, or it leaves doubt where
 * nobody pointed at it. \param[in] hinted whether somebody did \param[in] painted
 * whether by a mask, which says where the object ends */
PCL_SQ_EXPORTS std::string doubtAbout(const StereoView& view,
                                      const EstimationReport& report,
                                      bool hinted,
                                      bool painted = false);

} // namespace pcl_sq
