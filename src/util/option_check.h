// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sstream>
#include <string>

namespace pcl_sq::detail {

/** \brief Leaves a sentence where somebody wants it. \return false, for the caller's
 * own return */
inline bool refuse(std::string* why, const std::string& sentence) {
  if (why)
    *why = sentence;
  return false;
}

/** \brief Collects the first option that is out of range as a sentence. */
class OptionCheck {
public:
  explicit OptionCheck(std::string* why) : why_(why) {}

  /** \brief Both ends belong to the range; NaN does not. */
  template <typename Number>
  void inRange(const char* name, Number value, Number low, Number high) {
    if (passed_ && !(value >= low && value <= high))
      fail(name, value, low, high);
  }
  /** \brief Any other rule. */
  void require(bool holds, const char* sentence) {
    if (!passed_ || holds)
      return;
    passed_ = false;
    if (why_)
      *why_ = sentence;
  }
  bool passed() const { return passed_; }

private:
  template <typename Number>
  void fail(const char* name, Number value, Number low, Number high) {
    passed_ = false;
    if (!why_)
      return;
    std::ostringstream sentence;
    sentence << name << " is " << value << ", it must lie in [" << low << ", " << high
             << "]";
    *why_ = sentence.str();
  }

  std::string* why_;
  bool passed_ = true;
};

} // namespace pcl_sq::detail
