// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pcl_sq {

/** \brief What the fit says of one part. */
struct PartStatistics {
  std::size_t points = 0;    ///< points the part was fitted to
  double distortion = 0.0;   ///< D, Eq. (7), semi-axes in metres
  double rms_distance = 0.0; ///< [m]
  std::string termination;   ///< name of the Termination
};

/** \brief The contents of a model file (schema "pcl_sq/model", version 1; version 2
 * where a part is tapered, so that no reader of version 1 takes it for untapered;
 * version 3 where the table is known). */
struct PCL_SQ_EXPORTS ModelFile {
  MultiSuperquadric model;
  std::vector<PartStatistics> statistics; ///< one per part, or empty
  /** \brief The table it stands on, nx, ny, nz, d of n . p + d = 0 [m], n of unit
   * length and away from the ground; where one was found. */
  std::optional<std::array<double, 4>> table;
  std::string frame;               ///< name of the coordinate frame
  double distortion = 0.0;         ///< D of the union, Eq. (7) [m^1.5]
  double rms_distance = 0.0;       ///< of the union [m]
  std::string input_path;          ///< file the points came from
  std::size_t input_points = 0;    ///< points in it
  std::size_t finite_points = 0;   ///< of them finite
  std::string options_json = "{}"; ///< the options used, a JSON object
  std::vector<std::pair<std::string, double>> timings_ms; ///< stage, milliseconds
  std::string extra_json = "{}"; ///< further members of the top level, a JSON object
};

/** \brief The model as UTF-8 JSON, numbers with 17 significant digits.
 * \param[in] indent spaces per level; negative for one line
 * \throw pcl_sq::Exception if options_json is no JSON or extra_json no JSON object */
PCL_SQ_EXPORTS std::string toJson(const ModelFile& file, int indent = 2);

/** \brief Reads what toJson() wrote.
 *
 * Unknown versions, non-finite numbers, exponents or axes out of range and matrices
 * that are no rotations are refused. \param[out] file cleared on failure \param[out]
 * why the reason of a failure as a sentence (optional) \return whether the text was a
 * model */
[[nodiscard]] PCL_SQ_EXPORTS bool
fromJson(const std::string& text, ModelFile& file, std::string* why = nullptr);

/** \brief Writes a model file as toJson() gives it, whole or not at all; see
 * writeFile(). \param[in] path "-" is standard output \param[out] why the reason of a
 * failure (a full disk, no such folder, no right; a model that fromJson() would
 * refuse), a sentence without its full stop (optional) \return whether the file was
 * written */
[[nodiscard]] PCL_SQ_EXPORTS bool
saveModel(const std::string& path, const ModelFile& file, std::string* why = nullptr);

/** \brief Reads a model file. \param[in] path "-" is standard input
 * \param[out] file cleared on failure \param[out] why the reason of a failure: the file
 * cannot be read, or is none that fromJson() takes; a sentence without its full stop
 * (optional) \return whether there was a model */
[[nodiscard]] PCL_SQ_EXPORTS bool
loadModel(const std::string& path, ModelFile& file, std::string* why = nullptr);

} // namespace pcl_sq
