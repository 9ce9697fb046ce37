// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace pcl_sq::app {

/** \brief The whole file as text. \throw Failure if it cannot be read */
std::string readFile(const std::string& path);

/** \brief Lets \a write make a file under a temporary name beside \a path and renames
 * it, so that a crash leaves no half file. The temporary name keeps the extension.
 * \throw Failure if the folder cannot be written */
void writeAtomically(const std::string& path,
                     const std::function<void(const std::string& temporary)>& write);

/** \brief writeAtomically() for text. */
void writeTextFile(const std::string& path, const std::string& text);

/** \brief Fails now, before any work is done, if \a path cannot be written later.
 * \throw Failure naming the path */
void checkWritable(const std::string& path);

/** \brief Lower-case extension with its dot: ".pcd". */
std::string extensionOf(const std::string& path);

} // namespace pcl_sq::app
