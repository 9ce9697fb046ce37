// SPDX-License-Identifier: BSD-3-Clause
// What a program is given to judge, to grasp or to show: a model, or a scene of
// several.
#pragma once

#include "pcl_sq/scene_io.h"

#include <string>

namespace pcl_sq::app {

/** \brief A model file, or what is asked for of a scene file. */
struct ModelInput {
  ModelFile file;  ///< the model, the thing that was asked for, or all things as one
  SceneFile scene; ///< without objects where the file holds a model
};

/** \brief A thing of a scene as a model that stands on the scene's table.
 * \param[in] index from 0 on */
ModelFile thingOnTable(const SceneFile& scene, std::size_t index);

/** \brief Reads a model or a scene; the contents tell which.
 * \param[in] path "-" is standard input
 * \param[in] object number of a scene's thing, from 1 on; 0: all of them as one
 * \throw Failure where the file cannot be read or holds nothing \throw UsageError where
 * there is no such thing */
ModelInput readModelInput(const std::string& path, std::size_t object);

} // namespace pcl_sq::app
