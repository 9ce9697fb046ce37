// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "files/cloud_io.h"
#include "model/export_output.h"
#include "options/frame_options.h"

#include "pcl_sq/fit_tapered.h"
#include "pcl_sq/model_io.h"
#include "pcl_sq/object_surface_estimation.h"
#include "pcl_sq/tabletop_segmentation.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief What every program that makes a model asks the user. */
struct ModelOptions {
  CloudOptions cloud;
  EstimationOptions estimation;
  unsigned int threads = 0;
  std::vector<int> roi;    ///< x, y, w, h [px], or empty
  std::vector<double> box; ///< min x y z, max x y z [m], or empty
  bool remove_plane = false;
  std::string mask;               ///< PNG, or empty
  std::vector<double> intrinsics; ///< fx, fy, cx, cy [px], or empty
  FrameOptions frame;
  std::optional<bool> taper; ///< where the points demand one; with parts by default

  std::string output; ///< model JSON
  std::string mesh;
  std::string grasp_points;
  std::string snapshot;
  ExportOptions exported;
};

/** \brief Adds the options to a program. */
void addModelOptions(CLI::App& cli, ModelOptions& options);

/** \brief --taper and --no-taper. */
void addTaperOption(CLI::App& cli, ModelOptions& options);

/** \brief Refuses what cannot respect a taper. \throw UsageError */
void checkTaper(const ModelOptions& options);

/** \brief Whether a cloud shows its object from all round or from one side. */
void addCoverageOptions(CLI::App& cli, ModelOptions& options);

/** \brief Options of the best mode: preset, view, number of parts. */
void addViewOptions(CLI::App& cli, ModelOptions& options);

/** \brief The view that the options tell of. \throw Failure if the mask cannot be read
 */
ViewOptions makeView(const ModelOptions& options);

/** \brief Refuses contradictions and files that could not be written later. */
void checkModelOptions(const ModelOptions& options);

/** \brief A model and how it came about. */
struct ModelResult {
  ModelFile file;
  EstimationReport report;
  pcl::Indices object;                   ///< points that were given to the estimation
  std::optional<Eigen::Vector3d> up;     ///< normal of the table, where one is known
  std::optional<Eigen::Vector3d> sensor; ///< camera's place, known or guessed
  bool sensor_known = false;             ///< and not guessed
  std::optional<TaperedFit> taper;       ///< with --taper and one superquadric
};

/** \brief Region, plane removal and estimation. \throw Failure if there is no model */
ModelResult makeModel(const LoadedCloud& input,
                      const std::string& input_path,
                      const ModelOptions& options,
                      double load_ms);

/** \brief makeModel() in the cloud's own coordinates, which may be off the file's by
 * LoadedCloud::offset, and without the report as JSON. */
ModelResult makeNearModel(const LoadedCloud& input,
                          const std::string& input_path,
                          const ModelOptions& options,
                          double load_ms);

/** \brief Tells the result of table, up and the camera's place, as far as they are
 * known. \param[in] removed the table that the object was taken off */
void tellFrame(const LoadedCloud& input,
               const ModelOptions& options,
               const std::optional<TableModel>& removed,
               ModelResult& result);

/** \brief Tells the result's file of the model and of what its report says of it. */
void tellModel(const LoadedCloud& input,
               const std::string& input_path,
               const MultiSuperquadric& model,
               ModelResult& result);

/** \brief Gives the model's parts their tapers, where the data demand any.
 * \return whether they do \throw Failure if the points allow no fit */
bool addTaper(const LoadedCloud& input,
              const ModelOptions& options,
              ModelResult& result);

/** \brief Writes the files that the options name. */
void writeOutputs(const LoadedCloud& input,
                  const ModelResult& result,
                  const ModelOptions& options);

} // namespace pcl_sq::app
