// SPDX-License-Identifier: BSD-3-Clause
// From a loaded cloud and the options to all things on its table.
#pragma once

#include "options/model_options.h"

#include "pcl_sq/scene_estimation.h"
#include "pcl_sq/scene_io.h"

namespace pcl_sq::app {

/** \brief What a scene's program asks the user besides what models are made with. */
struct SceneChoices {
  LabelImage labels;    ///< things told apart elsewhere; empty: found
  int min_pixels = 150; ///< of a thing
};

/** \brief All things of a scene and how they came about. */
struct SceneResult {
  SceneFile file;
  std::vector<ModelResult> things; ///< one per object of the file
  LabelImage labels; ///< pixels of all things; those of thing k: numbers[k]
  std::vector<int> numbers;
};

/** \brief Adds what a scene's program asks, but for files and images, to a program. */
void addSceneOptions(CLI::App& cli, ModelOptions& options, SceneChoices& choices);

/** \brief Finds and fits all things. \throw Failure if there is none */
SceneResult makeSceneFile(const LoadedCloud& input,
                          const std::string& input_path,
                          const ModelOptions& options,
                          const SceneChoices& choices,
                          double load_ms);

/** \brief Number of each pixel's thing, from 1 on in the order of the file; 0: none. */
LabelImage numberedPixels(const SceneResult& result);

/** \brief The things for people, on stdout. */
void printScene(const SceneResult& result);

} // namespace pcl_sq::app
