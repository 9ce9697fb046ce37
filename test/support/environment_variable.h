// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <stdlib.h>

namespace pcl_sq::test {

/** \brief Another value of an environment variable for the time of its life. */
class EnvironmentVariable {
public:
  /** \param[in] value null: not set */
  EnvironmentVariable(const char* name, const char* value) : name_(name) {
    if (const char* before = getenv(name))
      before_ = before;
    assign(value);
  }
  ~EnvironmentVariable() { assign(before_ ? before_->c_str() : nullptr); }
  EnvironmentVariable(const EnvironmentVariable&) = delete;
  EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

private:
  void assign(const char* value) {
    if (value != nullptr)
      setenv(name_, value, 1);
    else
      unsetenv(name_);
  }
  const char* name_;
  std::optional<std::string> before_;
};

} // namespace pcl_sq::test
