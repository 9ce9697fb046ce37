// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "folder.h"

#include <string>

#include <sys/mount.h>

namespace pcl_sq::test {

/** \brief A disk of a few kilobytes, where the system lets a test have one. */
class SmallDisk {
public:
  SmallDisk() {
    const std::string size = "size=" + std::to_string(SIZE);
    mounted_ = mount("none", (folder_ / "").c_str(), "tmpfs", 0, size.c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_)
      umount2((folder_ / "").c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  static constexpr std::size_t SIZE = 65536;
  bool ok() const { return mounted_; }
  const Folder& folder() const { return folder_; }
  /** \brief Leaves no room for anything more. */
  void fill() const {
    folder_.write("filler", std::string(SIZE, 'x')); // as much as there is room for
  }

private:
  Folder folder_;
  bool mounted_ = false;
};

} // namespace pcl_sq::test
