// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/file_io.h"

#include <string>
#include <vector>

namespace pcl_sq::app {

using pcl_sq::extensionOf;
using pcl_sq::formatOf;

/** \brief The whole file, "-" for standard input. \throw Failure if it cannot be read
 */
std::string readFile(const std::string& path);

/** \brief Writes a file whole or not at all, "-" for standard output, and remembers it
 * for the line that tells what was written. \throw Failure if it cannot be written */
void writeOutput(const std::string& path, const std::string& bytes);

/** \brief Tells of a file that was written by other means than writeOutput(). */
void noteWritten(const std::string& path);

/** \brief "wrote a.json, b.png", or nothing if no file was written. */
std::string writtenFiles();

/** \brief Called for every file that an option names, before any work is done.
 *
 * What goes to standard output moves all that people read to standard error.
 * \param[in] path may be empty: the option was not given
 * \param[in] formats endings that the file may have, the first is that of standard
 * output, pipes and devices; none: any
 * \throw Failure if it cannot be written later
 * \throw UsageError for another ending, if another option names the same file, or if it
 * is an input */
void claimOutput(const std::string& option,
                 const std::string& path,
                 const std::vector<std::string>& formats = {});

/** \brief As claimOutput() for a folder that is made if it is absent. */
void claimFolder(const std::string& path);

/** \brief Makes a folder and those above it, where absent. \throw Failure */
void makeFolder(const std::string& path);

/** \brief Tells claimOutput() of a file that is read: no output may replace it. To be
 * called before. \throw UsageError if it is the second one on standard input */
void claimInput(const std::string& path);

} // namespace pcl_sq::app
