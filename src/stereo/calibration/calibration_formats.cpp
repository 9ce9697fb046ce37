// SPDX-License-Identifier: BSD-3-Clause
// Files of one program's own format: Kalibr, EuRoC, ZED, Middlebury.
#include "stereo/calibration/calibration_formats.h"

#include "stereo/calibration/calibration_names.h"

#include <opencv2/calib3d.hpp>

#include <cmath>
#include <map>

namespace pcl_sq::detail {
namespace {

const CalibrationEntry& required(const CalibrationDocument& document,
                                 const std::string& path) {
  const CalibrationEntry* entry = document.find(path);
  if (entry == nullptr)
    raiseLoad("'" + document.file + "' has no " + path +
              "; give the file that the calibration wrote.");
  return *entry;
}

std::string textOf(const CalibrationDocument& document, const std::string& path) {
  const CalibrationEntry* entry = document.find(path);
  return entry == nullptr ? std::string() : entry->text;
}

/** \brief Places of a rigid motion (4 x 4). */
void setMotion(const cv::Mat& right_from_left, RawStereoCameras& cameras) {
  cameras.R = right_from_left(cv::Rect(0, 0, 3, 3)).clone();
  cameras.T = right_from_left(cv::Rect(3, 0, 1, 3)).clone();
}

/** \brief The members that Kalibr and EuRoC share: intrinsics, distortion, size. */
void readCamera(const CalibrationDocument& document,
                const std::string& prefix,
                const char* coefficients,
                CalibrationContents& contents,
                cv::Mat& camera,
                cv::Mat& distortion) {
  const std::string path = prefix + "intrinsics";
  const cv::Mat k = matrixOf(required(document, path), path, 1, 4);
  const double* n = k.ptr<double>();
  camera = cameraMatrix(n[0], n[1], n[2], n[3]);
  const std::string model = textOf(document, prefix + "distortion_model");
  if (plainName(model) != "none") {
    const CalibrationEntry& entry = required(document, prefix + coefficients);
    distortion = entry.matrix().reshape(1, 1);
  }
  setLens(model, contents);
  if (const CalibrationEntry* size = document.find(prefix + "resolution")) {
    const cv::Mat pixels = matrixOf(*size, prefix + "resolution", 1, 2);
    contents.cameras.width = cv::saturate_cast<int>(pixels.at<double>(0));
    contents.cameras.height = cv::saturate_cast<int>(pixels.at<double>(1));
  }
}

} // namespace

cv::Mat
matrixOf(const CalibrationEntry& entry, const std::string& name, int rows, int cols) {
  if (entry.numbers.size() !=
      static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols))
    raiseLoad(name + " must hold " + std::to_string(rows) + " x " +
              std::to_string(cols) + " numbers but holds " +
              std::to_string(entry.numbers.size()) + "; correct the calibration file.");
  return entry.matrix().reshape(1, rows);
}

double numberOf(const CalibrationEntry& entry, const std::string& name) {
  if (entry.numbers.size() != 1)
    raiseLoad(name + " is not a number; correct the calibration file.");
  return entry.numbers.front();
}

cv::Mat cameraMatrix(double fx, double fy, double cx, double cy) {
  return (cv::Mat_<double>(3, 3) << fx, 0, cx, 0, fy, cy, 0, 0, 1);
}

void setLens(const std::string& model, CalibrationContents& contents) {
  if (model.empty())
    return;
  const LensName lens = understandLens(model);
  if (lens == LensName::UNKNOWN)
    raiseLoad(
        "the lens model '" + model +
        "' is not known; pinhole lenses with radial and tangential distortion "
        "(plumb_bob, radtan, rational_polynomial) and fisheyes (equidistant) are.");
  contents.cameras.fisheye = contents.cameras.fisheye || lens == LensName::FISHEYE;
}

bool readKalibr(const CalibrationDocuments& documents, CalibrationContents& contents) {
  if (documents.size() != 1 || !documents[0].hasPrefix("cam0/") ||
      documents[0].find("cam0/intrinsics") == nullptr)
    return false;
  const CalibrationDocument& d = documents[0];
  if (!d.hasPrefix("cam1/"))
    raiseLoad("'" + d.file +
              "' has cam0 but no cam1; calibrate both cameras together, or give K and "
              "the baseline.");
  RawStereoCameras& c = contents.cameras;
  std::string lenses[2];
  for (const int i : {0, 1}) {
    const std::string prefix = "cam" + std::to_string(i) + "/";
    const std::string camera = textOf(d, prefix + "camera_model");
    if (!camera.empty() && understandLens(camera) != LensName::PINHOLE)
      raiseLoad("the camera model '" + camera + "' of cam" + std::to_string(i) +
                " is not known; calibrate with Kalibr's pinhole-radtan or "
                "pinhole-equi.");
    lenses[i] = textOf(d, prefix + "distortion_model");
    readCamera(
        d, prefix, "distortion_coeffs", contents, i ? c.M2 : c.M1, i ? c.D2 : c.D1);
  }
  if (understandLens(lenses[0]) != understandLens(lenses[1]))
    raiseLoad("cam0 and cam1 have lenses of two kinds (" + lenses[0] + ", " +
              lenses[1] + "); calibrate both with one model.");
  if (const CalibrationEntry* motion = d.find("cam1/T_cn_cnm1"))
    setMotion(matrixOf(*motion, "cam1/T_cn_cnm1", 4, 4), c);
  else {
    const std::string left = "cam0/T_cam_imu", right = "cam1/T_cam_imu";
    if (d.find(left) == nullptr || d.find(right) == nullptr)
      raiseLoad("'" + d.file +
                "' has no cam1/T_cn_cnm1, the place of the right camera; "
                "give the camchain of both cameras.");
    setMotion(matrixOf(*d.find(right), right, 4, 4) *
                  matrixOf(*d.find(left), left, 4, 4).inv(),
              c);
  }
  if (d.hasPrefix("cam2/"))
    contents.notes.push_back("the calibration has more than two cameras; cam0 and cam1 "
                             "are taken for the left and the right one");
  contents.raw = true;
  return true;
}

bool readEuroc(const CalibrationDocuments& documents, CalibrationContents& contents) {
  if (documents.empty() || documents[0].find("T_BS") == nullptr)
    return false;
  if (documents.size() != 2)
    raiseLoad("'" + documents[0].file +
              "' describes one camera; give the files of both, the left one first.");
  RawStereoCameras& c = contents.cameras;
  readCamera(documents[0], "", "distortion_coefficients", contents, c.M1, c.D1);
  readCamera(documents[1], "", "distortion_coefficients", contents, c.M2, c.D2);
  // T_BS: from the sensor to the body
  setMotion(matrixOf(required(documents[1], "T_BS"), "T_BS", 4, 4).inv() *
                matrixOf(required(documents[0], "T_BS"), "T_BS", 4, 4),
            c);
  contents.raw = true;
  return true;
}

namespace {

/** \brief Sizes of the images that ZED's sections are for. */
const std::map<std::string, cv::Size>& zedSizes() {
  static const std::map<std::string, cv::Size> SIZES = {{"4K", {3840, 2160}},
                                                        {"4k", {3840, 2160}},
                                                        {"QHDPLUS", {3200, 1800}},
                                                        {"2K", {2208, 1242}},
                                                        {"FHD1200", {1920, 1200}},
                                                        {"FHD", {1920, 1080}},
                                                        {"HD1200", {1920, 1200}},
                                                        {"HD1080", {1920, 1080}},
                                                        {"HD", {1280, 720}},
                                                        {"SVGA", {960, 600}},
                                                        {"VGA", {672, 376}}};
  return SIZES;
}

/** \brief The section for images of a size; the only one if there is no other. */
std::string zedSection(const CalibrationDocument& d,
                       const cv::Size& images,
                       CalibrationContents& contents) {
  constexpr const char* PREFIX = "LEFT_CAM_";
  std::vector<std::string> names;
  for (const auto& [path, entry] : d.entries)
    if (path.rfind(PREFIX, 0) == 0) {
      const std::size_t begin = std::string(PREFIX).size();
      const std::string name = path.substr(begin, path.find('/') - begin);
      if (names.empty() || names.back() != name)
        names.push_back(name);
    }
  std::string list;
  for (const std::string& name : names) {
    list += (list.empty() ? "" : ", ") + name;
    const auto size = zedSizes().find(name);
    if (size != zedSizes().end() && size->second == images)
      return name;
  }
  if (names.size() != 1)
    raiseLoad("'" + d.file + "' has sections for several image sizes (" + list +
              ") and none fits the images" +
              (images.empty() ? std::string(", whose size is not known")
                              : " of " + std::to_string(images.width) + " x " +
                                    std::to_string(images.height) + " px") +
              "; give images as the camera delivers them.");
  if (!images.empty())
    contents.notes.push_back("the calibration's only section is " + names[0] +
                             "; it is taken for images of " +
                             std::to_string(images.width) + " x " +
                             std::to_string(images.height) + " px as it stands");
  return names[0];
}

double optionalNumber(const CalibrationDocument& d,
                      std::initializer_list<std::string> paths) {
  for (const std::string& path : paths)
    if (const CalibrationEntry* entry = d.find(path))
      return numberOf(*entry, path);
  return 0.0;
}

void readZedCamera(const CalibrationDocument& d,
                   const std::string& side,
                   const std::string& section,
                   cv::Mat& camera,
                   cv::Mat& distortion) {
  const std::string prefix = side + "_CAM_" + section + "/";
  const auto number = [&](const char* name) {
    return numberOf(required(d, prefix + name), prefix + name);
  };
  camera = cameraMatrix(number("fx"), number("fy"), number("cx"), number("cy"));
  // newer files have one section of a rational model for all sizes
  const bool rational = d.hasPrefix(side + "_DISTO/");
  const std::string from = rational ? side + "_DISTO/" : prefix;
  std::vector<double> coefficients;
  for (const char* name : {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"})
    coefficients.push_back(optionalNumber(d, {from + name}));
  if (!rational && coefficients[5] == 0.0 && coefficients[6] == 0.0 &&
      coefficients[7] == 0.0)
    coefficients.resize(5);
  distortion = cv::Mat(coefficients, true).reshape(1, 1);
}

} // namespace

bool readZed(const CalibrationDocuments& documents,
             const cv::Size& images,
             CalibrationContents& contents) {
  if (documents.size() != 1 || !documents[0].hasPrefix("LEFT_CAM_"))
    return false;
  const CalibrationDocument& d = documents[0];
  const std::string section = zedSection(d, images, contents);
  RawStereoCameras& c = contents.cameras;
  readZedCamera(d, "LEFT", section, c.M1, c.D1);
  readZedCamera(d, "RIGHT", section, c.M2, c.D2);
  // [STEREO] comes last, and some files leave its head out
  const std::string own = "RIGHT_CAM_" + section + "/";
  const auto stereo = [&](const std::string& name) {
    return optionalNumber(d,
                          {"STEREO/" + name + "_" + section,
                           "STEREO/" + name,
                           own + name + "_" + section,
                           own + name});
  };
  const double baseline = stereo("Baseline");
  if (baseline == 0.0)
    raiseLoad("'" + d.file +
              "' has no Baseline in its section [STEREO]; give the file "
              "that the camera's maker delivers.");
  const cv::Mat turn =
      (cv::Mat_<double>(3, 1) << stereo("RX"), stereo("CV"), stereo("RZ"));
  cv::Rodrigues(turn, c.R);
  c.T = 1e-3 * (cv::Mat_<double>(3, 1) << -baseline, stereo("TY"), stereo("TZ"));
  c.width = images.width;
  c.height = images.height;
  contents.raw = true;
  contents.metres = true;
  return true;
}

bool readMiddlebury(const CalibrationDocuments& documents,
                    CalibrationContents& contents) {
  if (documents.size() != 1 || documents[0].find("cam0") == nullptr)
    return false;
  const CalibrationDocument& d = documents[0];
  const cv::Mat cam0 = matrixOf(*d.find("cam0"), "cam0", 3, 3);
  StereoIntrinsics& k = contents.intrinsics;
  k.fx = cam0.at<double>(0, 0);
  k.fy = cam0.at<double>(1, 1);
  k.cx = cam0.at<double>(0, 2);
  k.cy = cam0.at<double>(1, 2);
  k.width = cv::saturate_cast<int>(optionalNumber(d, {"width"}));
  k.height = cv::saturate_cast<int>(optionalNumber(d, {"height"}));
  k.baseline = 1e-3 * numberOf(required(d, "baseline"), "baseline"); // in millimetres
  if (d.find("doffs") != nullptr)
    k.doffs = optionalNumber(d, {"doffs"});
  else if (d.find("cam1") != nullptr)
    k.doffs = matrixOf(*d.find("cam1"), "cam1", 3, 3).at<double>(0, 2) - k.cx;
  contents.metres = true;
  return true;
}

} // namespace pcl_sq::detail
