// SPDX-License-Identifier: BSD-3-Clause
// What goes wrong, as Python's exceptions with the programs' sentences.
#pragma once

#include "command_line/app.h"

#include "pcl_sq/exception.h"

#include <pybind11/pybind11.h>

namespace pcl_sq::python {

/** \brief Sets Python's exception; names of files may hold bytes that are not UTF-8. */
inline void setError(const pybind11::object& type, const std::string& sentence) {
  const auto text = pybind11::reinterpret_steal<pybind11::object>(PyUnicode_DecodeUTF8(
      sentence.data(), static_cast<Py_ssize_t>(sentence.size()), "backslashreplace"));
  PyErr_SetObject(type.ptr(), text.ptr());
}

/** \brief Runs work without the interpreter's lock. What contradicts itself becomes
 * ValueError, all other failures pcl_sq.Error. */
template <typename Work>
auto guarded(const Work& work) {
  const auto raise = [](const char* name, const std::string& sentence) {
    const pybind11::gil_scoped_acquire lock;
    pybind11::object type = pybind11::module_::import("pcl_sq._types").attr(name);
    setError(type, sentence);
    throw pybind11::error_already_set();
  };
  std::string sentence;
  bool usage = false;
  try {
    const pybind11::gil_scoped_release unlocked;
    return work();
  } catch (const app::UsageError& error) {
    sentence = app::sentenceOf(error);
    usage = true;
  } catch (const app::Failure& error) {
    sentence = app::sentenceOf(error);
  } catch (const Exception& error) {
    sentence = app::sentenceOf(error);
  } catch (const pybind11::error_already_set&) {
    throw;
  } catch (const std::exception& error) {
    sentence = app::sentenceOf(error);
  }
  raise(usage ? "OptionError" : "Error", sentence);
  throw app::Failure(sentence); // not reached
}

/** \brief What is out of range becomes pcl_sq.OptionError, which is a ValueError too,
 * in the module that calls this. */
inline void raiseOptionErrors() {
  pybind11::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown)
        std::rethrow_exception(thrown);
    } catch (const std::invalid_argument& error) {
      setError(pybind11::module_::import("pcl_sq._types").attr("OptionError"),
               error.what());
    }
  });
}

} // namespace pcl_sq::python
