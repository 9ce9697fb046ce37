// SPDX-License-Identifier: BSD-3-Clause
// Calibration of a stereo camera from pictures of a chessboard.
#include "command_line/app.h"
#include "command_line/value_checks.h"
#include "files/files.h"
#include "files/image_file.h"
#include "pcl_sq/stereo/stereo_calibration.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>

using namespace pcl_sq::app;

namespace {

struct Options {
  std::vector<std::string> images;
  std::string list, board = "9x6", output;
  double square = 0.0;
  bool rational = false;
};

using Corners = std::vector<std::vector<cv::Point2f>>;

/** \brief The board in all pairs that show it in both images. */
struct Views {
  cv::Size size, board;
  std::vector<std::vector<cv::Point3f>> world;
  Corners left, right;
};

struct Calibration : pcl_sq::RawStereoCameras {
  cv::Mat E, F, Q;
  double rms = 0.0, rms_left = 0.0, rms_right = 0.0; ///< reprojection [px]
  double row_error = 0.0; ///< mean difference of rows after rectification [px]
};

void addOptions(CLI::App& cli, Options& o) {
  cli.add_option("images", o.images, "All left images, then all right ones")
      ->type_name("LEFT... RIGHT...");
  cli.add_option("--list", o.list, "OpenCV image list: left, right, left, right...")
      ->type_name("FILE");
  cli.add_option("--board", o.board, "Inner corners of the chessboard")
      ->type_name("WxH")
      ->capture_default_str();
  cli.add_option("--square", o.square, "Side of one square [m]")
      ->required()
      ->check(positiveNumber(100.0))
      ->type_name("M");
  cli.add_flag("--rational", o.rational, "Eight lens coefficients, for wide angles");
  cli.add_option("-o,--output",
                 o.output,
                 "Calibration as OpenCV YAML or XML; -: YAML on standard output")
      ->required()
      ->type_name("FILE");
}

cv::Size boardSize(const std::string& text) {
  int width = 0, height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 3 ||
      height < 3 || width > 100 || height > 100)
    throw UsageError("--board wants inner corners as WxH, each 3 to 100, such as 9x6.");
  return {width, height};
}

/** \brief How deep the brackets of YAML or JSON, or the elements of XML, nest. */
int nestingOf(const std::string& text) {
  int depth = 0, deepest = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char next = i + 1 < text.size() ? text[i + 1] : '\0';
    if (text[i] == '[' || text[i] == '{' ||
        (text[i] == '<' && std::isalpha(static_cast<unsigned char>(next)) != 0))
      ++depth;
    else if (text[i] == ']' || text[i] == '}' || (text[i] == '<' && next == '/') ||
             (text[i] == '/' && next == '>'))
      --depth;
    deepest = std::max(deepest, depth);
  }
  return deepest;
}

/** \brief Pairs of file names. */
std::vector<std::pair<std::string, std::string>> pairsOf(const Options& o) {
  std::vector<std::pair<std::string, std::string>> pairs;
  if (o.list.empty()) {
    if (o.images.size() < 2 || o.images.size() % 2 != 0)
      throw UsageError("give as many right images as left ones, or --list.");
    const std::size_t half = o.images.size() / 2;
    for (std::size_t i = 0; i < half; ++i)
      pairs.emplace_back(o.images[i], o.images[half + i]);
    return pairs;
  }
  std::vector<std::string> names;
  // OpenCV's reader calls itself for each level of nesting
  constexpr int DEEPEST = 16;
  if (nestingOf(readFile(o.list)) > DEEPEST)
    throw Failure("'" + o.list + "' is no OpenCV image list with pairs of names.");
  try {
    const cv::FileStorage file(o.list, cv::FileStorage::READ);
    if (file.isOpened())
      for (const cv::FileNode& node : file.getFirstTopLevelNode())
        names.push_back(static_cast<std::string>(node));
  } catch (const cv::Exception&) {
    names.clear();
  }
  if (names.empty() || names.size() % 2 != 0)
    throw Failure("'" + o.list + "' is no OpenCV image list with pairs of names.");
  const auto folder = std::filesystem::path(o.list).parent_path();
  for (std::size_t i = 0; i < names.size(); i += 2)
    pairs.emplace_back((folder / names[i]).string(), (folder / names[i + 1]).string());
  return pairs;
}

bool findCorners(const std::string& path,
                 const cv::Size& board,
                 cv::Size& size,
                 std::vector<cv::Point2f>& corners) {
  const cv::Mat image = readImage(path, cv::IMREAD_GRAYSCALE);
  if (size.empty())
    size = image.size();
  if (size != image.size())
    throw Failure("'" + path + "' differs in size from the images before it.");
  if (!cv::findChessboardCorners(image, board, corners))
    return false;
  const cv::TermCriteria fine(
      cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 50, 1e-3);
  cv::cornerSubPix(image, corners, {8, 8}, {-1, -1}, fine);
  return true;
}

Views findBoards(const Options& o) {
  Views views;
  views.board = boardSize(o.board);
  std::vector<cv::Point3f> board;
  for (int v = 0; v < views.board.height; ++v)
    for (int u = 0; u < views.board.width; ++u)
      board.emplace_back(
          static_cast<float>(u * o.square), static_cast<float>(v * o.square), 0.0f);
  const auto pairs = pairsOf(o);
  Progress progress("Chessboards", pairs.size());
  std::size_t done = 0;
  for (const auto& [left, right] : pairs) {
    std::vector<cv::Point2f> a, b;
    const bool found = findCorners(left, views.board, views.size, a) &&
                       findCorners(right, views.board, views.size, b);
    progress.update(++done);
    if (found) {
      views.left.push_back(a);
      views.right.push_back(b);
      views.world.push_back(board);
    } else
      note("there is no " + o.board + " chessboard in both '" + left + "' and '" +
           right + "'; the pair is left out");
  }
  if (views.world.size() < 4)
    throw Failure("the chessboard was found in " + std::to_string(views.world.size()) +
                  " pairs only; at least 4 are needed: check --board.");
  return views;
}

/** \brief Mean difference of the rows of corresponding corners after rectification. */
double rowError(const Views& views, const Calibration& c) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < views.world.size(); ++i) {
    std::vector<cv::Point2f> a, b;
    cv::undistortPoints(views.left[i], a, c.M1, c.D1, c.R1, c.P1);
    cv::undistortPoints(views.right[i], b, c.M2, c.D2, c.R2, c.P2);
    for (std::size_t k = 0; k < a.size(); ++k)
      sum += std::abs(static_cast<double>(a[k].y) - static_cast<double>(b[k].y));
    count += a.size();
  }
  return sum / static_cast<double>(count);
}

Calibration calibrate(const Views& views, bool rational) {
  Calibration c;
  // k3 is told from k1 and k2 only by wide angles
  const int flags = rational ? cv::CALIB_RATIONAL_MODEL : cv::CALIB_FIX_K3;
  std::vector<cv::Mat> r, t;
  c.rms_left =
      cv::calibrateCamera(views.world, views.left, views.size, c.M1, c.D1, r, t, flags);
  c.rms_right = cv::calibrateCamera(
      views.world, views.right, views.size, c.M2, c.D2, r, t, flags);
  c.rms = cv::stereoCalibrate(
      views.world,
      views.left,
      views.right,
      c.M1,
      c.D1,
      c.M2,
      c.D2,
      views.size,
      c.R,
      c.T,
      c.E,
      c.F,
      cv::CALIB_USE_INTRINSIC_GUESS | flags,
      cv::TermCriteria(cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 200, 1e-7));
  c.width = views.size.width;
  c.height = views.size.height;
  c.Q = pcl_sq::rectifyPinholes(c);
  c.row_error = rowError(views, c);
  return c;
}

/** \brief Squares in millimetres make a baseline that every reader refuses. */
void refuseImplausibleBaseline(const Calibration& c, double square) {
  const double length = cv::norm(c.T);
  const double smallest = pcl_sq::StereoIntrinsics::SMALLEST_BASELINE;
  const double largest = pcl_sq::StereoIntrinsics::LARGEST_BASELINE;
  if (length >= smallest && length <= largest)
    return;
  char text[300];
  std::snprintf(text,
                sizeof(text),
                "the baseline would be %.4g m with --square %g, which is not plausible "
                "(%g to %g m); give the side of a square in metres, %g for %g mm.",
                length,
                square,
                smallest,
                largest,
                1e-3 * square,
                square);
  throw Failure(text);
}

void write(const std::string& path, const Views& views, const Calibration& c) {
  cv::FileStorage out(formatOf(path, ".yml"),
                      cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  out << "image_width" << views.size.width << "image_height" << views.size.height
      << "M1" << c.M1 << "D1" << c.D1 << "M2" << c.M2 << "D2" << c.D2 << "R" << c.R
      << "T" << c.T << "R1" << c.R1 << "R2" << c.R2 << "P1" << c.P1 << "P2" << c.P2
      << "Q" << c.Q << "rms_px" << c.rms << "epipolar_error_px" << c.row_error;
  writeOutput(path, out.releaseAndGetString());
}

int work(const Options& o) {
  claimInput(o.list);
  for (const std::string& image : o.images)
    claimInput(image);
  claimOutput("--output", o.output, {".yml", ".yaml", ".xml"});
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  const Views views = findBoards(o);
  StageLine line;
  line.show("calibrating");
  const Calibration c = calibrate(views, o.rational);
  if (c.T.at<double>(0) > 0.0)
    throw Failure("the second camera is left of the first; exchange the left and right "
                  "images.");
  if (!std::isfinite(c.rms) || !std::isfinite(c.row_error))
    throw Failure(
        "the calibration did not converge; take pictures of the board in more "
        "poses.");
  refuseImplausibleBaseline(c, o.square);
  write(o.output, views, c);
  if (!quiet())
    std::printf("%zu pairs of %d x %d px\n"
                "reprojection rms   %.3f px (left %.3f, right %.3f)\n"
                "epipolar error     %.3f px (mean difference of rows, rectified)\n"
                "baseline           %.5f m, focal length %.2f px\n",
                views.world.size(),
                views.size.width,
                views.size.height,
                c.rms,
                c.rms_left,
                c.rms_right,
                c.row_error,
                cv::norm(c.T),
                c.P1.at<double>(0, 0));
  return DONE;
}

} // namespace

int main(int argc, char** argv) {
  Options options;
  return run(
      argc,
      argv,
      "pcl_sq_calibrate",
      "Calibrates a stereo camera from pictures of a chessboard.",
      "  pcl_sq_calibrate left*.png right*.png --board 9x6 --square 0.025 -o "
      "calib.yml\n"
      "  pcl_sq_calibrate --list stereo_calib.xml --board 9x6 --square 1 -o "
      "calib.yml\n",
      [&](CLI::App& cli) { addOptions(cli, options); },
      [&] { return work(options); });
}
