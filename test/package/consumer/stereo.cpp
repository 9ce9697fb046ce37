// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_sq/stereo/stereo_reprojector.h>

#include <cmath>
#include <cstdio>

// links and runs against the installed library: Z = f B / d (paper, Eq. 1)
int main() {
  pcl_sq::StereoIntrinsics camera;
  camera.width = 8;
  camera.height = 6;
  camera.fx = camera.fy = 500.0;
  camera.cx = 4.0;
  camera.cy = 3.0;
  camera.baseline = 0.12;
  const cv::Mat disparity(6, 8, CV_32F, cv::Scalar(50.0));
  const cv::Mat grey(6, 8, CV_8U, cv::Scalar(128));
  const auto cloud = pcl_sq::reprojectDisparity(disparity, grey, camera);
  std::printf("depth %.6f\n", double(cloud->at(2, 1).z));
  return std::abs(cloud->at(2, 1).z - 1.2f) < 1e-6f ? 0 : 1;
}
