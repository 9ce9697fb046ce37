// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/calibration/calibration_names.h"

#include <cctype>
#include <initializer_list>
#include <map>
#include <utility>

namespace pcl_sq::detail {
namespace {

using M = CalibrationMeaning;

/** \brief Names that belong to one camera, without its side. */
const std::map<std::string, M>& namesOfACamera() {
  static const std::map<std::string, M> NAMES = {
      {"k", M::CAMERA_MATRIX},
      {"m", M::CAMERA_MATRIX},
      {"cm", M::CAMERA_MATRIX},
      {"mtx", M::CAMERA_MATRIX},
      {"matrix", M::CAMERA_MATRIX},
      {"cameramatrix", M::CAMERA_MATRIX},
      {"cammatrix", M::CAMERA_MATRIX},
      {"cameramat", M::CAMERA_MATRIX},
      {"cammat", M::CAMERA_MATRIX},
      {"intrinsic", M::CAMERA_MATRIX},
      {"intrinsics", M::CAMERA_MATRIX},
      {"intrinsicmatrix", M::CAMERA_MATRIX},
      {"d", M::DISTORTION},
      {"dc", M::DISTORTION},
      {"dist", M::DISTORTION},
      {"distortion", M::DISTORTION},
      {"distcoeff", M::DISTORTION},
      {"distcoeffs", M::DISTORTION},
      {"distcoef", M::DISTORTION},
      {"distcoefs", M::DISTORTION},
      {"distortioncoeff", M::DISTORTION},
      {"distortioncoeffs", M::DISTORTION},
      {"distortioncoefficients", M::DISTORTION},
      {"distortionvector", M::DISTORTION},
      {"rect", M::RECTIFICATION},
      {"rectification", M::RECTIFICATION},
      {"rectificationmatrix", M::RECTIFICATION},
      {"rectifyrotation", M::RECTIFICATION},
      {"rectrotation", M::RECTIFICATION},
      {"rectmatrix", M::RECTIFICATION},
      {"p", M::PROJECTION},
      {"proj", M::PROJECTION},
      {"projection", M::PROJECTION},
      {"projectionmatrix", M::PROJECTION},
      {"projmatrix", M::PROJECTION},
      {"projmat", M::PROJECTION},
      {"cameramodel", M::LENS_MODEL},
      {"distortionmodel", M::LENS_MODEL},
      {"width", M::WIDTH},
      {"imagewidth", M::WIDTH},
      {"height", M::HEIGHT},
      {"imageheight", M::HEIGHT},
      {"size", M::SIZE},
      {"resolution", M::SIZE},
      {"imagesize", M::SIZE}};
  return NAMES;
}

/** \brief Names that belong to the pair. */
const std::map<std::string, M>& namesOfThePair() {
  static const std::map<std::string, M> NAMES = {
      {"r", M::ROTATION},
      {"rot", M::ROTATION},
      {"rotation", M::ROTATION},
      {"rotationmatrix", M::ROTATION},
      {"stereorotation", M::ROTATION},
      {"stereor", M::ROTATION},
      {"om", M::ROTATION},
      {"rvec", M::ROTATION},
      {"t", M::TRANSLATION},
      {"trans", M::TRANSLATION},
      {"translation", M::TRANSLATION},
      {"translationvector", M::TRANSLATION},
      {"translationmatrix", M::TRANSLATION},
      {"stereotranslation", M::TRANSLATION},
      {"stereot", M::TRANSLATION},
      {"tvec", M::TRANSLATION},
      {"q", M::REPROJECTION},
      {"disptodepth", M::REPROJECTION},
      {"disparitytodepth", M::REPROJECTION},
      {"disptodepthmatrix", M::REPROJECTION},
      {"disparitytodepthmatrix", M::REPROJECTION},
      {"reprojectionmatrix", M::REPROJECTION},
      {"w", M::WIDTH},
      {"width", M::WIDTH},
      {"imagewidth", M::WIDTH},
      {"imgwidth", M::WIDTH},
      {"camerawidth", M::WIDTH},
      {"calibrationwidth", M::WIDTH},
      {"h", M::HEIGHT},
      {"height", M::HEIGHT},
      {"imageheight", M::HEIGHT},
      {"imgheight", M::HEIGHT},
      {"cameraheight", M::HEIGHT},
      {"calibrationheight", M::HEIGHT},
      {"size", M::SIZE},
      {"imagesize", M::SIZE},
      {"imgsize", M::SIZE},
      {"resolution", M::SIZE},
      {"imageresolution", M::SIZE},
      {"lensmodel", M::LENS_MODEL},
      {"cameramodel", M::LENS_MODEL},
      {"cameratype", M::LENS_MODEL},
      {"modeltype", M::LENS_MODEL},
      {"distortionmodel", M::LENS_MODEL},
      {"distortiontype", M::LENS_MODEL},
      {"projectionmodel", M::LENS_MODEL},
      {"e", M::HARMLESS},
      {"f", M::HARMLESS},
      {"essentialmatrix", M::HARMLESS},
      {"fundamentalmatrix", M::HARMLESS},
      {"h1", M::HARMLESS},
      {"h2", M::HARMLESS}};
  return NAMES;
}

/** \brief Parts of names of what is written for information only. */
bool isHarmless(const std::string& plain) {
  for (const char* part : {"essential",
                           "fundamental",
                           "homography",
                           "roi",
                           "error",
                           "err",
                           "rms",
                           "covariance",
                           "deviation",
                           "points",
                           "corner",
                           "board",
                           "chessboard",
                           "pattern",
                           "timu",
                           "tcamimu",
                           "extrinsicparameters"})
    if (plain.find(part) != std::string::npos)
      return true;
  return false;
}

/** \brief The name without its side, if it has one there. */
bool stripSide(const std::string& plain, std::string& rest, CalibrationName& name) {
  struct Affix {
    const char* text;
    int side;
    bool from_zero;
  };
  static const Affix AFFIXES[] = {{"left", 1, false},
                                  {"right", 2, false},
                                  {"cam0", 1, true},
                                  {"camera0", 1, true},
                                  {"camera1", 1, false},
                                  {"camera2", 2, false},
                                  {"cam1", 1, false},
                                  {"cam2", 2, false},
                                  {"0", 1, true},
                                  {"1", 1, false},
                                  {"2", 2, false},
                                  {"l", 1, false},
                                  {"r", 2, false}};
  for (const bool front : {false, true})
    for (const Affix& affix : AFFIXES) {
      const std::string text = affix.text;
      if (plain.size() <= text.size())
        continue;
      if (front ? plain.rfind(text, 0) != 0
                : plain.compare(plain.size() - text.size(), text.size(), text) != 0)
        continue;
      rest = front ? plain.substr(text.size())
                   : plain.substr(0, plain.size() - text.size());
      if (rest != "r" && namesOfACamera().count(rest) == 0)
        continue;
      name.side = affix.side;
      name.from_zero = affix.from_zero;
      return true;
    }
  return false;
}

} // namespace

std::string plainName(const std::string& name) {
  std::string plain;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)))
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return plain;
}

CalibrationName understandName(const std::string& name) {
  const std::string plain = plainName(name);
  CalibrationName result;
  if (const auto it = namesOfThePair().find(plain); it != namesOfThePair().end()) {
    result.meaning = it->second;
    return result;
  }
  std::string rest;
  if (stripSide(plain, rest, result)) {
    // the rotation of one camera is the one that rectifies it
    result.meaning = rest == "r" ? M::RECTIFICATION : namesOfACamera().at(rest);
    return result;
  }
  if (isHarmless(plain))
    result.meaning = M::HARMLESS;
  return result;
}

LensName understandLens(const std::string& name) {
  const std::string plain = plainName(name);
  for (const char* known : {"pinhole",
                            "perspective",
                            "plumbbob",
                            "radtan",
                            "radialtangential",
                            "brown",
                            "brownconrady",
                            "rationalpolynomial",
                            "rational",
                            "thinprism",
                            "opencv",
                            "standard",
                            "none",
                            "nodistortion",
                            "rectified",
                            "ideal"})
    if (plain == known)
      return LensName::PINHOLE;
  for (const char* known : {"equidistant",
                            "equi",
                            "fisheye",
                            "opencvfisheye",
                            "kannalabrandt",
                            "kannalabrandt4",
                            "kb4",
                            "pinholeequi"})
    if (plain == known)
      return LensName::FISHEYE;
  return LensName::UNKNOWN;
}

} // namespace pcl_sq::detail
