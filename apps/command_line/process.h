// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace pcl_sq::app {

/** \brief To be called first of all in main().
 *
 * A broken pipe and a limit on the size of files become failures of the write. Ctrl-C,
 * SIGTERM and SIGHUP remove what is half written before they end the program. */
void beginProcess();

/** \brief Tells which files were written, flushes standard output and looks whether all
 * of it was taken. \return \a code, or that of a failure with its sentence on stderr */
int endProcess(const std::string& name, int code);

/** \brief What to do before Ctrl-C, SIGTERM or SIGHUP end the program; runs in a thread
 * of its own, while the others go on. Empty: nothing more. */
void setInterruptAction(std::function<void()> action);

} // namespace pcl_sq::app
