// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/calibration/calibration_text.h"

#include "pcl_sq/exception.h"
#include "stereo/calibration/calibration_tree.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>

namespace pcl_sq::detail {

void raiseLoad(const std::string& what) {
  throw Exception("[pcl_sq::StereoCalibration::load] " + what);
}
namespace {

using Tree = CalibrationTree;

constexpr std::size_t LARGEST_FILE = 1 << 20; // a calibration is small

/** \brief Numbers between blanks and commas; false if one of the words is none. */
bool parseNumbers(std::string text, std::vector<double>& numbers) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream in(text);
  for (std::string word; in >> word;) {
    double number = 0.0;
    if (!parseNumber(word, number))
      return false;
    numbers.push_back(number);
  }
  return true;
}

/** \brief A word, or numbers in rows: "a b c; d e f" within brackets or without. */
CalibrationEntry entryOf(const std::string& text) {
  CalibrationEntry entry;
  entry.text = text;
  std::string rest = text;
  rest.erase(std::remove_if(
                 rest.begin(), rest.end(), [](char c) { return c == '[' || c == ']'; }),
             rest.end());
  std::istringstream rows(rest);
  for (std::string row; std::getline(rows, row, ';');) {
    const std::size_t before = entry.numbers.size();
    if (!parseNumbers(row, entry.numbers)) {
      entry.numbers.clear();
      entry.rows = 0;
      break;
    }
    entry.rows += entry.numbers.size() > before;
  }
  if (entry.rows > 0 && entry.numbers.size() % std::size_t(entry.rows) == 0)
    entry.cols = static_cast<int>(entry.numbers.size()) / entry.rows;
  else if (entry.rows > 0) {
    entry.rows = 1;
    entry.cols = static_cast<int>(entry.numbers.size());
  }
  return entry;
}

/** \brief Appends the numbers of a list of numbers or of lists; false if there is
 * anything else in it. */
bool appendNumbers(const Tree& list, std::vector<double>& numbers) {
  for (const auto& [name, item] : list.children) {
    if (item.kind == Tree::MAP ||
        (item.kind == Tree::LIST && !appendNumbers(item, numbers)))
      return false;
    if (item.kind == Tree::SCALAR && !parseNumbers(item.text, numbers))
      return false;
  }
  return true;
}

CalibrationEntry entryOf(const Tree& list) {
  CalibrationEntry entry;
  if (!appendNumbers(list, entry.numbers) || entry.numbers.empty()) {
    entry.numbers.clear();
    return entry;
  }
  const bool nested = list.children.front().second.kind == Tree::LIST;
  const auto count = static_cast<int>(entry.numbers.size());
  const auto rows = static_cast<int>(list.children.size());
  entry.rows = nested && count % rows == 0 ? rows : 1;
  entry.cols = count / entry.rows;
  return entry;
}

/** \brief OpenCV's and ROS's form of a matrix: rows, cols, data. */
bool asMatrix(const Tree& map, const std::string& path, CalibrationEntry& entry) {
  const Tree* rows = map.child("rows");
  const Tree* cols = map.child("cols");
  const Tree* data = map.child("data");
  if (rows == nullptr || cols == nullptr || data == nullptr)
    return false;
  entry = data->kind == Tree::LIST ? entryOf(*data) : entryOf(data->text);
  double r = 0.0, c = 0.0;
  const auto count = static_cast<double>(entry.numbers.size());
  const bool sizes = parseNumber(rows->text, r) && parseNumber(cols->text, c);
  if (sizes && r * c == 0.0 && entry.numbers.empty() && r >= 0.0 && c >= 0.0)
    return true; // an empty matrix
  // several channels stand beside each other
  if (!sizes || !(r >= 1.0 && c >= 1.0) || count == 0.0 ||
      std::fmod(count, r * c) != 0.0)
    raiseLoad("the matrix " + path + " does not hold rows x cols numbers (" +
              std::to_string(entry.numbers.size()) +
              " were read); correct the calibration file.");
  entry.rows = static_cast<int>(r);
  entry.cols = static_cast<int>(count / r);
  return true;
}

void flatten(const Tree& tree, const std::string& path, CalibrationDocument& document) {
  if (tree.kind == Tree::MAP) {
    CalibrationEntry entry;
    if (asMatrix(tree, path, entry))
      document.add(path, entry);
    else
      for (const auto& [name, child] : tree.children)
        flatten(child, path.empty() ? name : path + "/" + name, document);
  } else
    document.add(path, tree.kind == Tree::LIST ? entryOf(tree) : entryOf(tree.text));
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos)
    return "";
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

bool isComment(const std::string& line) {
  return line[0] == '#' || line[0] == ';' || line.rfind("//", 0) == 0;
}

/** \brief A line without the comment behind it: words after a blank and a mark, for
 * rows of numbers stand between semicolons too. */
std::string withoutComment(const std::string& line) {
  for (std::size_t i = 1; i < line.size(); ++i)
    if ((line[i] == ';' || line[i] == '#') &&
        std::isspace(static_cast<unsigned char>(line[i - 1])) != 0) {
      const std::size_t first = line.find_first_not_of(" \t;#", i);
      if (first == std::string::npos ||
          std::isalpha(static_cast<unsigned char>(line[first])) != 0)
        return trimmed(line.substr(0, i));
    }
  return line;
}

/** \brief "name=value" or "name: value" in lines, under "[section]"s if there are any;
 * false if a line is neither. */
bool readLines(const std::string& text, CalibrationDocument& document) {
  std::istringstream in(text);
  std::string section;
  for (std::string line; std::getline(in, line);) {
    line = trimmed(line);
    if (line.empty() || isComment(line))
      continue;
    line = withoutComment(line);
    if (line.front() == '[' && line.back() == ']') {
      section = trimmed(line.substr(1, line.size() - 2)) + "/";
      continue;
    }
    const std::size_t sign = line.find_first_of("=:");
    if (sign == std::string::npos || sign == 0)
      return false;
    const std::string name = section + trimmed(line.substr(0, sign));
    const std::string value = trimmed(line.substr(sign + 1));
    const CalibrationEntry entry = entryOf(value);
    if (entry.numbers.empty() && !value.empty() &&
        std::string("0123456789+-.[").find(value[0]) != std::string::npos)
      raiseLoad("the value of " + name + ", '" + value +
                "', is not a number; correct the calibration file.");
    document.add(name, entry);
  }
  return true;
}

/** \brief Text without YAML's or XML's marks: lines, or YAML without its header. */
bool looksLikeLines(const std::string& text) {
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    line = trimmed(line);
    if (line.empty() || isComment(line))
      continue;
    if (line.front() == '[')
      return true;
    const std::size_t sign = line.find_first_of("=:");
    return sign != std::string::npos && line[sign] == '=';
  }
  return false;
}

} // namespace

cv::Mat CalibrationEntry::matrix() const {
  return numbers.empty() ? cv::Mat() : cv::Mat(numbers, true).reshape(1, rows);
}

const CalibrationEntry* CalibrationDocument::find(const std::string& path) const {
  const auto it = entries.find(path);
  return it == entries.end() ? nullptr : &it->second;
}

void CalibrationDocument::add(const std::string& path, CalibrationEntry entry) {
  if (!entries.emplace(path, std::move(entry)).second)
    raiseLoad("'" + file + "' says " + path + " twice; leave out one of the two.");
}

bool CalibrationDocument::hasPrefix(const std::string& prefix) const {
  const auto it = entries.lower_bound(prefix);
  return it != entries.end() && it->first.rfind(prefix, 0) == 0;
}

CalibrationDocument CalibrationDocument::below(const std::string& prefix) const {
  CalibrationDocument part{file, {}};
  for (const auto& [path, entry] : entries)
    if (path.rfind(prefix, 0) == 0)
      part.entries.emplace(path.substr(prefix.size()), entry);
  return part;
}

bool parseNumber(const std::string& text, double& number) {
  // what from_chars does not know of: a sign for positive ones, YAML's dots
  const char* begin = text.data() + (text.rfind('+', 0) == 0 ? 1 : 0);
  const char* end = text.data() + text.size();
  if (begin != end && *begin == '.' && begin + 1 != end &&
      std::isalpha(static_cast<unsigned char>(begin[1])))
    ++begin;
  const auto [stop, error] = std::from_chars(begin, end, number);
  return error == std::errc() && stop == end && begin != end;
}

std::vector<CalibrationDocument> parseCalibrationText(const std::string& text,
                                                      const std::string& file) {
  const std::size_t bom = text.rfind("\xef\xbb\xbf", 0) == 0 ? 3 : 0;
  const std::size_t begin = text.find_first_not_of(" \t\r\n", bom);
  if (begin == std::string::npos)
    raiseLoad("'" + file + "' is empty; give a calibration file.");
  if (text.size() > LARGEST_FILE || text.find('\0') != std::string::npos)
    raiseLoad("'" + file +
              "' is no text, or longer than a calibration is; give a "
              "calibration file.");
  const std::string content = text.substr(begin);
  std::vector<Tree> trees;
  if (content[0] == '{')
    trees = {parseJsonTree(content, file)};
  else if (content[0] == '<')
    trees = {parseXml(content, file)};
  else if (content[0] != '%' && looksLikeLines(content)) {
    CalibrationDocument document{file, {}};
    if (!readLines(content, document))
      raiseLoad("'" + file +
                "' has a line that is neither name=value nor a [section]; correct the "
                "calibration file.");
    return {document};
  } else
    trees = parseYaml(content, file);
  std::vector<CalibrationDocument> documents;
  for (const Tree& tree : trees) {
    documents.push_back({file, {}});
    flatten(tree, "", documents.back());
  }
  return documents;
}

} // namespace pcl_sq::detail
