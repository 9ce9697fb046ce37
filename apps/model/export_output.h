// SPDX-License-Identifier: BSD-3-Clause
// A model for robots' software, and as a page to turn.
#pragma once

#include "files/cloud_io.h"

#include "pcl_sq/scene_io.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief Files that a model is exported to. */
struct ExportOptions {
  std::vector<std::string> exports; ///< .urdf, .sdf, .scene or .glb
  std::string html;                 ///< page, or empty
  bool any() const { return !exports.empty() || !html.empty(); }
};

/** \brief Adds --export and --html to a program. */
void addExportOptions(CLI::App& cli, ExportOptions& options);

/** \brief The same for all things of a scene. */
void addSceneExportOptions(CLI::App& cli, ExportOptions& options);

/** \brief Adds --html alone. */
void addHtmlOption(CLI::App& cli, ExportOptions& options);

/** \brief Refuses files that could not be written later. */
void checkExportOptions(const ExportOptions& options);
/** \brief The same where a scene is written. */
void checkSceneExportOptions(const ExportOptions& options);

/** \brief Writes the files. \param[in] cloud of the page, or nullptr
 * \throw Failure */
void writeExports(const ExportOptions& options,
                  const ModelFile& file,
                  const LoadedCloud* cloud);
/** \brief The same for all things of a scene. \throw Failure */
void writeExports(const ExportOptions& options,
                  const SceneFile& scene,
                  const LoadedCloud* cloud);

} // namespace pcl_sq::app
