// SPDX-License-Identifier: BSD-3-Clause
// A model as a page: numbers in base64 beside view.html, which draws them.
#include "export/part_surface.h"
#include "export/view_page.h"
#include "export/xml_text.h"
#include "io/json_text.h"

#include "pcl_sq/html_view.h"
#include "pcl_sq/palette.h"
#include "pcl_sq/sides.h"

namespace pcl_sq {

using detail::Json;
using detail::vectorToJson;

namespace {

std::string base64(const std::string& bytes) {
  static const char* const DIGITS =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8U |
             (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : DIGITS[word >> (18U - 6U * k) & 63U];
  }
  return text;
}

template <typename T>
std::string base64(const std::vector<T>& numbers) {
  return base64(std::string(reinterpret_cast<const char*>(numbers.data()),
                            numbers.size() * sizeof(T)));
}

/** \brief Places in 16 bits of a box: enough for 15 micrometres of a metre. */
struct Grid {
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), step = Eigen::Vector3d::Ones();

  explicit Grid(const Eigen::AlignedBox3d& box) {
    if (box.isEmpty())
      return;
    low = box.min();
    step = (box.sizes() / 65535.0).cwiseMax(1e-12);
  }
  void add(const Eigen::Vector3d& p, std::vector<std::uint16_t>& cells) const {
    const Eigen::Array3d q = ((p - low).array() / step.array()).round();
    for (const double cell : q)
      cells.push_back(static_cast<std::uint16_t>(std::clamp(cell, 0.0, 65535.0)));
  }
  Json json() const {
    return {{"low", vectorToJson(low)}, {"step", detail::vectorToJson(step)}};
  }
};

/** \brief The part's surface about the middle of all. */
Json partJson(const Superquadric& part,
              const detail::PartLabel& label,
              const Eigen::Vector3d& middle) {
  const detail::ShownSurface surface = detail::shownSurface(part);
  const Grid grid(part.boundingBox());
  std::vector<std::uint16_t> places, corners;
  std::vector<std::int8_t> normals;
  for (const Eigen::Vector3d& v : surface.mesh.vertices)
    grid.add(v, places);
  for (const Eigen::Vector3d& n : surface.normals)
    for (const double c : n)
      normals.push_back(static_cast<std::int8_t>(std::lround(127.0 * c)));
  for (const auto& t : surface.mesh.triangles)
    for (const std::uint32_t corner : t)
      corners.push_back(static_cast<std::uint16_t>(corner));
  const Color& color = label.color;
  Grid moved = grid;
  moved.low -= middle;
  return {{"name", label.name},
          {"color", {color.r, color.g, color.b}},
          {"sides", vectorToJson(sidesOf(part))},
          {"epsilon", {part.epsilon1, part.epsilon2}},
          {"taper", {part.kx, part.ky}},
          {"wall", part.wall},
          {"bend", part.bend},
          {"grid", moved.json()},
          {"places", base64(places)},
          {"normals", base64(normals)},
          {"corners", base64(corners)}};
}

/** \brief The finite points near the model, evenly chosen. */
Json cloudJson(const CloudPoints& points,
               const Eigen::Vector3d& offset,
               const std::vector<std::uint32_t>& colors,
               const Eigen::AlignedBox3d& near,
               std::size_t most,
               const Eigen::Vector3d& middle) {
  std::vector<Eigen::Index> kept;
  Eigen::AlignedBox3d box;
  const auto at = [&](Eigen::Index i) {
    return Eigen::Vector3d(points.col(i).cast<double>() + offset);
  };
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (points.col(i).allFinite() && near.contains(at(i))) {
      kept.push_back(i);
      box.extend(at(i));
    }
  const std::size_t count = std::min(kept.size(), most);
  Grid grid(box);
  std::vector<std::uint16_t> places;
  std::vector<std::uint8_t> bytes;
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Index i = kept[k * kept.size() / count];
    grid.add(at(i), places);
    if (!colors.empty())
      for (const unsigned shift : {16U, 8U, 0U})
        bytes.push_back(
            static_cast<std::uint8_t>(colors[std::size_t(i)] >> shift & 255U));
  }
  grid.low -= middle;
  return {{"grid", grid.json()},
          {"places", base64(places)},
          {"colors", base64(bytes)},
          {"of", kept.size()}};
}

/** \brief A hand as lines: palm, two or three fingers. \param[in] length from the palm
 * to the contacts [m] */
Json graspJson(const Json& grasp, double length, const Eigen::Vector3d& middle) {
  const auto vector = [](const Json& v) {
    return Eigen::Vector3d(v.at(0), v.at(1), v.at(2));
  };
  const Eigen::Vector3d position = vector(grasp.at("position"));
  const Eigen::Vector3d approach = vector(grasp.at("approach"));
  const Eigen::Vector3d palm = position - length * approach;
  std::vector<float> lines;
  const auto add = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    for (const Eigen::Vector3d& p : {a, b})
      for (int k = 0; k < 3; ++k)
        lines.push_back(static_cast<float>(p[k] - middle[k]));
  };
  add(palm, palm - 0.4 * length * approach);
  for (const Json& contact : grasp.at("contacts")) {
    const Eigen::Vector3d tip = vector(contact.at("position"));
    const Eigen::Vector3d knuckle =
        tip - (approach.dot(tip - position) + length) * approach;
    add(palm, knuckle);
    add(knuckle, tip);
  }
  return {{"lines", base64(lines)},
          {"score", grasp.at("scores").at("total")},
          {"width", grasp.at("width")}};
}

Json graspsJson(const Json& extra, const Eigen::Vector3d& middle) {
  constexpr std::size_t SHOWN = 50;
  Json grasps = Json::array();
  try {
    const Json& hand = extra.at("gripper");
    const double length = hand.at("finger_length").get<double>() -
                          0.5 * hand.at("pad_length").get<double>();
    for (const Json& grasp : extra.at("grasps"))
      if (grasps.size() < SHOWN)
        grasps.push_back(graspJson(grasp, length, middle));
  } catch (const Json::exception&) { // a file without grasps, or not of ours
  }
  return grasps;
}

std::string pageOf(const ModelFile& file,
                   const std::vector<detail::PartLabel>& labels,
                   const CloudPoints& points,
                   const Eigen::Vector3d& offset,
                   const std::vector<std::uint32_t>& colors,
                   const HtmlViewOptions& options) {
  Eigen::AlignedBox3d box = file.model.boundingBox();
  if (file.model.empty())
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      if (points.col(i).allFinite())
        box.extend(points.col(i).cast<double>() + offset);
  const Eigen::Vector3d middle =
      box.isEmpty() ? Eigen::Vector3d(offset) : Eigen::Vector3d(box.center());
  const double diagonal = box.isEmpty() ? 1.0 : box.diagonal().norm();
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(options.context * diagonal);
  const Eigen::AlignedBox3d near(box.min() - margin, box.max() + margin);
  const Json extra = Json::parse(file.extra_json);
  Json page = {{"title", options.title}, {"radius", 0.5 * diagonal}};
  page["parts"] = Json::array();
  for (std::size_t i = 0; i < file.model.size(); ++i)
    page["parts"].push_back(partJson(file.model.parts[i], labels[i], middle));
  page["cloud"] = cloudJson(points, offset, colors, near, options.max_points, middle);
  page["grasps"] = graspsJson(extra, middle);
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();
  if (file.table) {
    const auto& t = *file.table;
    up = Eigen::Vector3d(t[0], t[1], t[2]);
    page["table"] = {{"normal", vectorToJson(up)}, {"height", -t[3] - up.dot(middle)}};
  }
  const auto report = extra.find("report");
  if (report != extra.end() && report->is_object()) {
    const auto vector = [&](const char* key, Eigen::Vector3d& v) {
      const auto found = report->find(key);
      if (found == report->end() || !found->is_array() || found->size() != 3)
        return false;
      for (int k = 0; k < 3; ++k)
        v[k] = (*found)[std::size_t(k)].is_number()
                   ? (*found)[std::size_t(k)].get<double>()
                   : 0.0;
      return true;
    };
    Eigen::Vector3d sensor;
    if (vector("sensor", sensor))
      page["camera"] = vectorToJson(sensor - middle);
    Eigen::Vector3d told;
    if (!file.table && vector("up", told) && told.norm() > 1e-9)
      up = told.normalized();
  }
  const Eigen::Quaterniond turn = detail::toYUp(up);
  page["up"] = {turn.x(), turn.y(), turn.z(), turn.w()};
  std::string html = detail::viewPage();
  // "</script>" in a name would end the page's script
  std::string data = page.dump(-1, ' ', true, Json::error_handler_t::replace);
  for (std::size_t at = 0; (at = data.find("</", at)) != std::string::npos; at += 3)
    data.replace(at, 2, "<\\/");
  const auto replace = [&html](const std::string& mark, const std::string& text) {
    const std::size_t at = html.find(mark);
    if (at != std::string::npos)
      html.replace(at, mark.size(), text);
  };
  replace("@TITLE@", detail::escaped(options.title));
  replace("@DATA@", data);
  return html;
}

} // namespace

std::string htmlView(const ModelFile& file,
                     const CloudPoints& points,
                     const Eigen::Vector3d& offset,
                     const std::vector<std::uint32_t>& colors,
                     const HtmlViewOptions& options) {
  return pageOf(file, detail::labelsOf(file.model), points, offset, colors, options);
}

std::string htmlView(const SceneFile& scene,
                     const CloudPoints& points,
                     const Eigen::Vector3d& offset,
                     const std::vector<std::uint32_t>& colors,
                     const HtmlViewOptions& options) {
  ModelFile file = detail::asOneModel(scene);
  Json extra = Json::parse(scene.extra_json);
  if (!scene.objects.empty()) { // one camera has seen all
    const Json first = Json::parse(scene.objects.front().file.extra_json);
    if (first.contains("report"))
      extra["report"] = first["report"];
  }
  file.extra_json = extra.dump();
  return pageOf(file, detail::labelsOf(scene), points, offset, colors, options);
}

} // namespace pcl_sq
