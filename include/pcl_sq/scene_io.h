// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/cell_mask.h"
#include "pcl_sq/model_io.h"

namespace pcl_sq {

/** \brief One thing of a scene file: what a model file holds, and where it was seen. */
struct SceneFileObject {
  ModelFile file;
  CellRect roi;                   ///< box of its pixels in the image [px]
  int pixels = 0;                 ///< seen of it
  double visible = 1.0;           ///< share of it that nothing nearer hides, [0, 1]
  double confidence = 0.0;        ///< see EstimationReport::confidence, [0, 1]
  std::vector<std::string> notes; ///< fall-backs, one sentence each
};

/** \brief The contents of a scene file (schema "pcl_sq/scene", version 1). */
struct PCL_SQ_EXPORTS SceneFile {
  std::vector<SceneFileObject> objects;
  /** \brief The table, as in ModelFile::table. */
  std::optional<std::array<double, 4>> table;
  std::string frame;               ///< name of the coordinate frame
  std::string input_path;          ///< file the points came from
  std::size_t input_points = 0;    ///< points in it
  std::size_t finite_points = 0;   ///< of them finite
  std::string options_json = "{}"; ///< the options used, a JSON object
  std::vector<std::pair<std::string, double>> timings_ms; ///< stage, milliseconds
  std::vector<std::string> notes; ///< fall-backs and what was left out, sentences
  std::string extra_json = "{}";  ///< further members of the top level, a JSON object

  /** \brief All things as one union. \param[in] without index of an object that is left
   * out; any other number: none */
  MultiSuperquadric all(std::size_t without = std::size_t(-1)) const;
};

/** \brief The scene as UTF-8 JSON. Each of its objects is a whole model file by itself,
 * with the members roi, pixels, visible, confidence and notes.
 * \param[in] indent spaces per level; negative for one line
 * \throw pcl_sq::Exception if options_json is no JSON or extra_json no JSON object */
PCL_SQ_EXPORTS std::string toJson(const SceneFile& file, int indent = 2);

/** \brief Whether a JSON text says that it is a scene: its schema, no more. */
[[nodiscard]] PCL_SQ_EXPORTS bool isScene(const std::string& text);

/** \brief Reads what toJson() wrote; what fromJson() of a model file refuses in an
 * object is refused here. \param[out] file cleared on failure \param[out] why the
 * reason of a failure as a sentence (optional) \return whether the text was a scene */
[[nodiscard]] PCL_SQ_EXPORTS bool
fromJson(const std::string& text, SceneFile& file, std::string* why = nullptr);

/** \brief Writes a scene file whole or not at all. \param[in] path "-" is standard
 * output \param[out] why the reason of a failure, a sentence without its full stop
 * (optional) \return whether the file was written */
[[nodiscard]] PCL_SQ_EXPORTS bool
saveScene(const std::string& path, const SceneFile& file, std::string* why = nullptr);

/** \brief Reads a scene file. \param[in] path "-" is standard input \param[out] file
 * cleared on failure \param[out] why the reason of a failure, a sentence without its
 * full stop (optional) \return whether there was a scene */
[[nodiscard]] PCL_SQ_EXPORTS bool
loadScene(const std::string& path, SceneFile& file, std::string* why = nullptr);

} // namespace pcl_sq
