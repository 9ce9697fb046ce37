// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/calibration/calibration_tree.h"

#include "io/json_text.h"
#include "stereo/calibration/calibration_text.h"

#include <boost/property_tree/xml_parser.hpp>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <sstream>

namespace pcl_sq::detail {
namespace {

// Calibrations are small and flat; what is not is none, or meant to do harm.
constexpr int DEEPEST = 16;
constexpr std::size_t MOST_NODES = 20000;

/** \brief Stops what nests or repeats itself without end (YAML's aliases can). */
struct Bounds {
  const std::string& file;
  std::size_t nodes = 0;

  void enter(int depth) {
    if (depth > DEEPEST || ++nodes > MOST_NODES)
      raiseLoad("'" + file +
                "' nests or repeats too much for a calibration; give the "
                "calibration's own file.");
  }
};

CalibrationTree toTree(const YAML::Node& node, Bounds& bounds, int depth = 0) {
  bounds.enter(depth);
  CalibrationTree tree;
  if (node.IsScalar())
    tree.text = node.Scalar();
  else if (node.IsSequence()) {
    tree.kind = CalibrationTree::LIST;
    for (const YAML::Node& item : node)
      tree.children.emplace_back("", toTree(item, bounds, depth + 1));
  } else if (node.IsMap()) {
    tree.kind = CalibrationTree::MAP;
    for (const auto& item : node)
      tree.children.emplace_back(item.first.IsScalar() ? item.first.Scalar() : "",
                                 toTree(item.second, bounds, depth + 1));
  }
  return tree;
}

CalibrationTree
toTree(const nlohmann::ordered_json& json, Bounds& bounds, int depth = 0) {
  bounds.enter(depth);
  CalibrationTree tree;
  if (json.is_structured()) {
    tree.kind = json.is_array() ? CalibrationTree::LIST : CalibrationTree::MAP;
    for (const auto& [key, value] : json.items())
      tree.children.emplace_back(json.is_array() ? std::string() : key,
                                 toTree(value, bounds, depth + 1));
  } else if (json.is_string())
    tree.text = json.get<std::string>();
  else if (!json.is_null())
    tree.text = json.dump();
  return tree;
}

CalibrationTree
toTree(const boost::property_tree::ptree& node, Bounds& bounds, int depth = 0) {
  bounds.enter(depth);
  CalibrationTree tree;
  tree.text = node.data();
  bool list = false;
  for (const auto& [key, value] : node) {
    if (key == "<xmlattr>" || key == "<xmlcomment>")
      continue;
    list = list || key == "_"; // OpenCV's name of an element of a list
    tree.children.emplace_back(key == "_" ? "" : key, toTree(value, bounds, depth + 1));
  }
  if (!tree.children.empty())
    tree.kind = list ? CalibrationTree::LIST : CalibrationTree::MAP;
  return tree;
}

/** \brief How deep the elements of an XML text nest, at most. */
int xmlDepth(const std::string& text) {
  int depth = 0, deepest = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    if ((text[i] == '<' && text[i + 1] == '/') ||
        (text[i] == '/' && text[i + 1] == '>'))
      --depth;
    else if (text[i] == '<' && text[i + 1] != '?' && text[i + 1] != '!')
      deepest = std::max(deepest, ++depth);
  return deepest;
}

/** \brief The documents of a YAML text, between lines of "---": YAML::LoadAll() never
 * ends on some texts that are damaged. Directives (%YAML:1.0) have nothing to say. */
std::vector<std::string> documentsOf(const std::string& text) {
  std::vector<std::string> documents(1);
  std::istringstream in(text);
  std::size_t lines = 0;
  for (std::string line; std::getline(in, line); ++lines) {
    const bool directive = line.rfind('%', 0) == 0;
    if (line.rfind("---", 0) == 0) {
      documents.emplace_back(lines, '\n'); // messages count the text's lines
      line.erase(0, 3);
    }
    documents.back() += (directive ? std::string() : line) + "\n";
  }
  return documents;
}

} // namespace

const CalibrationTree* CalibrationTree::child(const std::string& name) const {
  for (const auto& [key, value] : children)
    if (key == name)
      return &value;
  return nullptr;
}

std::vector<CalibrationTree> parseYaml(const std::string& text,
                                       const std::string& file) {
  std::vector<CalibrationTree> documents;
  try {
    Bounds bounds{file};
    for (const std::string& part : documentsOf(text)) {
      const YAML::Node node = YAML::Load(part);
      if (node.IsNull())
        continue;
      if (!node.IsMap())
        raiseLoad("'" + file +
                  "' is neither YAML, XML or JSON nor lines of name=value; give a "
                  "calibration file.");
      documents.push_back(toTree(node, bounds));
    }
  } catch (const YAML::Exception& error) {
    raiseLoad("'" + file + "' is not valid YAML" +
              (error.mark.is_null()
                   ? std::string()
                   : " at line " + std::to_string(error.mark.line + 1)) +
              "; correct the calibration file.");
  }
  return documents;
}

CalibrationTree parseJsonTree(const std::string& text, const std::string& file) {
  nlohmann::ordered_json json;
  std::string why;
  if (!parseJson(text, json, &why))
    raiseLoad("'" + file + "': " + why + "; correct the calibration file.");
  Bounds bounds{file};
  return toTree(json, bounds);
}

CalibrationTree parseXml(const std::string& text, const std::string& file) {
  Bounds bounds{file};
  if (xmlDepth(text) > DEEPEST)
    bounds.enter(DEEPEST + 1);
  boost::property_tree::ptree root;
  std::istringstream in(text);
  try {
    boost::property_tree::read_xml(in, root);
  } catch (const boost::property_tree::xml_parser_error& error) {
    raiseLoad("'" + file + "' is not valid XML at line " +
              std::to_string(error.line()) + "; correct the calibration file.");
  }
  for (const auto& [name, child] : root)
    if (name != "<xmlcomment>")
      return toTree(child, bounds);
  return {};
}

} // namespace pcl_sq::detail
