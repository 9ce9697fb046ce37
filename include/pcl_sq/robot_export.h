// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/graspit_export.h"
#include "pcl_sq/scene_io.h"

#include <string>
#include <vector>

namespace pcl_sq {

/** \brief Settings of the export to robots' formats. */
struct PCL_SQ_EXPORTS RobotExportOptions {
  std::string name = "object"; ///< of the object; letters, digits, _ and -
  double density = 500.0;      ///< [kg/m^3], a filled household container; [1, 30000]
  /** \brief How far a box, cylinder or sphere may stand off a part that it collides in
   * place of, in half diagonals of the part's box, [0, 1]. */
  double primitive_tolerance = 0.05;
  /** \brief Of the meshes' file names in URDF and SDF, such as
   * "package://my_robot/meshes/"; empty: beside the file. */
  std::string mesh_prefix;

  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

/** \name A model for robots' software, as the files of a folder
 *
 * The first file is the one that is asked for, the others are meshes that it names.
 * Lengths are metres, masses kilograms. A part is a box, a cylinder or a sphere where
 * it nearly is one, else a convex mesh; a hollow part's walls are
 * convex pieces and leave the opening open. The object's frame has the axes of the
 * cloud's frame and its origin in the centre of gravity; its pose in the cloud's frame
 * is that of the file's joint, model or object. Mass and inertia are those of the
 * material (massProperties()).
 * \return empty for an empty model or options out of range */
///@{
/** \brief URDF: a link named as the cloud's frame ("world" without one), a fixed joint
 * and the object's link with its visual, collision and inertia. */
PCL_SQ_EXPORTS std::vector<TextFile> urdfFiles(const ModelFile& file,
                                               const RobotExportOptions& options = {});
/** \brief SDF 1.7: a model with one link. */
PCL_SQ_EXPORTS std::vector<TextFile> sdfFiles(const ModelFile& file,
                                              const RobotExportOptions& options = {});
/** \brief MoveIt's planning scene as text (.scene, as its RViz panel imports it): the
 * object, and the table as a box of 1 x 1 x 0.02 m below it where one is known. */
PCL_SQ_EXPORTS std::vector<TextFile>
moveitFiles(const ModelFile& file, const RobotExportOptions& options = {});
/** \brief Binary glTF 2.0: a node a part, named "part 1" ..., in partColor(); extras
 * hold semi-axes, exponents and sides. glTF's y is up: away from the table where one is
 * known, else against the camera's y. */
PCL_SQ_EXPORTS std::vector<TextFile> glbFiles(const ModelFile& file,
                                              const RobotExportOptions& options = {});
/** \brief One of the above by the ending ".urdf", ".sdf", ".scene" or ".glb"; empty for
 * another ending. */
PCL_SQ_EXPORTS std::vector<TextFile> robotFiles(const std::string& ending,
                                                const ModelFile& file,
                                                const RobotExportOptions& options = {});
///@}

/** \name All things of a scene in one file
 * \return empty for a scene without things or options out of range */
///@{
/** \brief MoveIt: an object NAME_1, NAME_2 ... for each thing, and the table
 * NAME_table.
 */
PCL_SQ_EXPORTS std::vector<TextFile>
moveitFiles(const SceneFile& scene, const RobotExportOptions& options = {});
/** \brief Binary glTF: the parts of a thing share its colour and are named "thing 1",
 * or "thing 1, part 1" ... where it has several. */
PCL_SQ_EXPORTS std::vector<TextFile> glbFiles(const SceneFile& scene,
                                              const RobotExportOptions& options = {});
/** \brief One of these by the ending ".scene" or ".glb"; empty for another ending. */
PCL_SQ_EXPORTS std::vector<TextFile> robotFiles(const std::string& ending,
                                                const SceneFile& scene,
                                                const RobotExportOptions& options = {});
///@}

} // namespace pcl_sq
