// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/visualization/snapshot_renderer.h"
#include "visualization/output_file.h"

namespace pcl_sq {

/** \throws pcl_sq::Exception if the path does not end in .png */
void requirePng(const std::string& path, const std::string& who);

/** \brief A PNG file that appears when it is complete. */
class PngFile {
public:
  /** \throws pcl_sq::Exception if the name does not end in .png or cannot be written */
  PngFile(const std::string& path, const std::string& who);
  /** \throws pcl_sq::Exception if writing fails, e.g. on a full disk */
  void write(const SnapshotImage& image);

private:
  std::string who_, path_;
  OutputFile file_;
};

} // namespace pcl_sq
