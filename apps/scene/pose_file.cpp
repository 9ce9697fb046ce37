// SPDX-License-Identifier: BSD-3-Clause
#include "scene/pose_file.h"

#include "command_line/app.h"
#include "command_line/value_checks.h"
#include "files/files.h"
#include "report/text.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <vector>

namespace pcl_sq::app {
namespace {

/** \brief The numbers between the brackets after "NAME:" in an OpenCV YAML file. */
std::string matrixText(const std::string& yaml, const std::string& name) {
  const std::size_t at = yaml.find(name + ":");
  const std::size_t data = at == std::string::npos ? at : yaml.find("data:", at);
  const std::size_t open = data == std::string::npos ? data : yaml.find('[', data);
  const std::size_t close = open == std::string::npos ? open : yaml.find(']', open);
  if (close == std::string::npos)
    throw Failure("the pose file has no matrix '" + name + "'.");
  return yaml.substr(open + 1, close - open - 1);
}

std::vector<double> numbersOf(std::string text) {
  std::replace_if(
      text.begin(),
      text.end(),
      [](char c) { return c == ',' || c == ';' || c == '[' || c == ']'; },
      ' ');
  std::istringstream in(text);
  std::vector<double> numbers;
  for (std::string word; in >> word;) {
    double x = 0.0;
    if (!parseNumber(word, x) || !(std::abs(x) <= 1e20))
      throw Failure("the pose holds " + app::quoted(word) +
                    ", which is no number below 1e20.");
    numbers.push_back(x);
  }
  return numbers;
}

} // namespace

void readPose(const std::string& text,
              Eigen::Matrix3d& rotation,
              Eigen::Vector3d& translation) {
  std::error_code error;
  std::string content = text;
  const std::size_t colon = text.rfind(':');
  if (std::filesystem::exists(text, error))
    content = readFile(text);
  else if (colon != std::string::npos)
    content = matrixText(readFile(text.substr(0, colon)), text.substr(colon + 1));
  const std::vector<double> n = numbersOf(content);
  if (n.size() != 16)
    throw Failure("a pose has 16 numbers (4 x 4, in rows), not " +
                  std::to_string(n.size()) + ".");
  using RowMajor = Eigen::Matrix<double, 4, 4, Eigen::RowMajor | Eigen::DontAlign>;
  const RowMajor m = Eigen::Map<const RowMajor>(n.data());
  rotation = m.topLeftCorner<3, 3>();
  translation = m.topRightCorner<3, 1>();
  const double skew = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity())
                          .cwiseAbs()
                          .maxCoeff();
  if (!(skew < 1e-4) || rotation.determinant() < 0.0 || !translation.allFinite())
    throw Failure("the pose is not a rotation and a translation in rows.");
}

} // namespace pcl_sq::app
