// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <string>

namespace pcl_sq::app {

/** \brief A rigid motion given as 16 numbers in rows: the numbers themselves with
 * commas between, the name of a file that holds them, or FILE:NAME for the matrix NAME
 * of an OpenCV YAML file. \throw Failure if it is none of these or no rigid motion */
void readPose(const std::string& text,
              Eigen::Matrix3d& rotation,
              Eigen::Vector3d& translation);

} // namespace pcl_sq::app
