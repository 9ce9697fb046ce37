// SPDX-License-Identifier: BSD-3-Clause
#include "io/temporary_file.h"

#include "pcl_sq/file_io.h"

#include <cerrno>
#include <mutex>
#include <set>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace pcl_sq {
namespace detail {
namespace {

/** \brief Names of the hidden files that exist now, and who guards them: a file is made
 * or renamed, and its name noted, in one step. */
struct Registry {
  std::mutex mutex;
  std::set<std::string> names;
};

Registry& registry() {
  static Registry the_one;
  return the_one;
}

bool isNamed(int descriptor, const std::string& name) {
  struct stat open_file = {}, named = {};
  return fstat(descriptor, &open_file) == 0 && lstat(name.c_str(), &named) == 0 &&
         open_file.st_dev == named.st_dev && open_file.st_ino == named.st_ino;
}

/** \brief Whether this program is now the only one to hold the file. */
bool isLocked(int descriptor, const std::string& name) {
  const bool taken = flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  return !taken && isNamed(descriptor, name);
}

/** \brief Removes what a program left that was killed: nobody holds its lock. */
void removeLeftover(const std::string& name) {
  const int descriptor = open(name.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0)
    return;
  if (isLocked(descriptor, name))
    unlink(name.c_str());
  close(descriptor);
}

} // namespace

bool TemporaryFile::open(const std::string& name) {
  const int flags = O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  for (int attempt = 0; attempt < 2; ++attempt) {
    descriptor_ = ::open(name.c_str(), flags, 0666);
    if (descriptor_ >= 0) {
      if (isLocked(descriptor_, name))
        return true;
      close(descriptor_); // another program took it for a leftover just now
      descriptor_ = -1;
    } else if (errno == EEXIST)
      removeLeftover(name);
    else
      failToWrite(path_, errno);
  }
  return false;
}

TemporaryFile::TemporaryFile(const std::string& path, const OutputTarget& target)
    : path_(path), target_(target.path) {
  // the same name each time, so that what a killed program leaves is found by the next
  constexpr std::size_t LONGEST = 240; // of 255, the rest is for the number
  const std::string stem = "." + target_.filename().string().substr(0, LONGEST);
  constexpr int MOST_WRITERS = 1000;
  const std::lock_guard<std::mutex> lock(registry().mutex);
  for (int i = 0; i < MOST_WRITERS && descriptor_ < 0; ++i) {
    name_ = (target_.parent_path() / (stem + ".pcl_sq" + std::to_string(i))).string();
    if (registry().names.count(name_) == 0 && open(name_))
      registry().names.insert(name_);
  }
  if (descriptor_ < 0)
    failToWrite(path, EBUSY);
  if (target.exists) {
    // only root may give files away; the rights count for everybody
    [[maybe_unused]] const int ignored =
        fchown(descriptor_, target.status.st_uid, target.status.st_gid);
    fchmod(descriptor_, target.status.st_mode & 0777);
  }
}

TemporaryFile::~TemporaryFile() {
  const std::lock_guard<std::mutex> lock(registry().mutex);
  if (registry().names.erase(name_) > 0)
    unlink(name_.c_str());
  if (descriptor_ >= 0)
    close(descriptor_);
}

void TemporaryFile::takeName() {
  const std::lock_guard<std::mutex> lock(registry().mutex);
  if (rename(name_.c_str(), target_.c_str()) != 0)
    failToWrite(path_, errno);
  registry().names.erase(name_);
  name_.clear(); // it may be another writer's by now
}

void TemporaryFile::finish() {
  // file systems over a network tell of a full disk when a descriptor is closed; it is
  // a second one, as the lock must last until the file has its name
  const int descriptor = fcntl(descriptor_, F_DUPFD_CLOEXEC, 0);
  if (descriptor >= 0 && close(descriptor) != 0 && errno != EINTR)
    failToWrite(path_, errno);
}

} // namespace detail

void removeTemporaries() {
  const std::lock_guard<std::mutex> lock(detail::registry().mutex);
  for (const std::string& name : detail::registry().names)
    unlink(name.c_str());
  detail::registry().names.clear();
}

} // namespace pcl_sq
