// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/grasp.h"
#include "pcl_sq/mass_properties.h"

namespace pcl_sq {

/** \brief A file of an export, its path relative to the folder GRASPIT points to. */
struct TextFile {
  std::string path;
  std::string contents;
};

/** \brief Settings of the export to GraspIt!. */
struct PCL_SQ_EXPORTS GraspitOptions {
  std::string name = "object"; ///< of the files; letters, digits, _ and -
  std::string material =
      "plastic";          ///< one that GraspIt! knows: plastic, wood, metal...
  double density = 500.0; ///< [kg/m^3], a filled household container; [1, 30000]
  /** \brief Largest distance of mesh and surface [m], [1e-6, 0.1]. A thousandth of the
   * longest side where that is less, a 2500th where that is more: a mesh then has some
   * thousand triangles, as GraspIt!'s own have. */
  double tolerance = 1e-4;
  bool part_bodies = false; ///< also one body per part
  bool has_table = false;
  Eigen::Vector3d table_normal = Eigen::Vector3d::UnitZ(); ///< unit, towards the object
  double table_offset = 0.0;   ///< d of normal . p + d = 0 [m]
  MultiSuperquadric obstacles; ///< other things about it, as one body that stays
  std::vector<Grasp> grasps;   ///< candidates for GraspIt!'s grasp tester
  double retreat = 0.1; ///< way back from a grasp to where its line starts [m], >= 0
  Gripper gripper;      ///< that they were planned for

  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

/** \brief The object for the simulator GraspIt! (Miller and Allen 2004) as text files.
 *
 * They belong into the user's GraspIt! folder, to which the environment variable
 * GRASPIT points: its worlds name bodies relative to that folder, and only there the
 * primitive planner looks. Units are millimetres and grams, the quaternion's w comes
 * first:
 * - worlds/NAME.xml: the graspableBody, the table as obstacle, a camera;
 * - worlds/NAME_parts.xml, with part_bodies: one graspableBody a part in its place, in
 *   place of the whole;
 * - models/objects/NAME.xml: material, mass, cog, inertia_matrix, geometryFile; as
 *   GraspIt! multiplies the matrix by the mass, it is that of unit mass [mm^2];
 * - models/objects/NAME.off: the union's closed surface about the centre of gravity,
 *   vertices on it, no triangle on two parts;
 * - models/objects/primitives/NAME.iv: one box, cylinder or sphere per part, for the
 *   primitive planner, which looks there for a file of the body's name;
 * - models/obstacles/NAME_table.xml and .off, with a table: 0.3 mm below the lowest
 *   vertex of the mesh unless that is held up by a tenth of its size, because
 * GraspIt!'s dynamics do not start from bodies that touch;
 * - models/obstacles/NAME_others.xml and .off, with obstacles: all of them, in the
 *   cloud's frame;
 * - NAME_grasps.txt, with grasps: one a line, [palm][approach][thumb]spread, as the
 *   planner's dialogue reads it. The palm is \a retreat back from the grasp: the tester
 *   moves the hand along the approach until it touches. The dialogue takes the lines
 * for the Barrett hand only; spread is 60 degrees for three fingers, and 0, two fingers
 *   beside each other and the thumb opposite, for two jaws;
 * - with part_bodies, models/objects/NAME_part0.xml, .off and so on.
 *
 * The body's frame has the axes of the cloud's frame and its origin in the centre of
 * gravity, so that the world's transform is the pose in the cloud's frame. GraspIt!'s
 * gravity is along the world's -z whatever the table's normal: turn the model so that z
 * is up before dynamics. Friction is not exported: GraspIt! takes it from the pair of
 * materials (userMaterials, Materials in its settings).
 * \return empty for an empty model or options out of range */
PCL_SQ_EXPORTS std::vector<TextFile> graspitFiles(const MultiSuperquadric& model,
                                                  const GraspitOptions& options = {});

/** \brief A pose as GraspIt! writes it: (w x y z)[x y z] in millimetres. */
PCL_SQ_EXPORTS std::string graspitTransform(const Eigen::Matrix3d& rotation,
                                            const Eigen::Vector3d& translation);

} // namespace pcl_sq
