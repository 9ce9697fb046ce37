// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dlfcn.h>

#include <string>

namespace pcl_sq::detail {

/** \brief A function of a library that few runs need and that takes long to load, with
 * all that it links: VTK, GDAL. It is loaded on first use and stays.
 *
 * The dynamic linker looks for it where the library or program that calls this is told
 * to look (its RUNPATH: pcl_sq_plug_in() of the build), so this is inline; then where
 * the build installs it, for Debian's packages have no RUNPATH.
 * \param[in] file name of the library \param[in] symbol name of the C function
 * \param[out] why what is wrong and what to do, in a sentence without its stop
 * \return null where there is none */
template <typename Function>
inline Function* functionOf(const char* file, const char* symbol, std::string* why) {
  void* library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
#ifdef PCL_SQ_PLUG_IN_PATH
  if (library == nullptr)
    library = dlopen((PCL_SQ_PLUG_IN_PATH "/" + std::string(file)).c_str(),
                     RTLD_NOW | RTLD_LOCAL);
#endif
  void* function = library == nullptr ? nullptr : dlsym(library, symbol);
  if (function == nullptr) {
    const char* reason = dlerror(); // NOLINT(concurrency-mt-unsafe): a thread's own
    *why = "the plug-in " + std::string(file) + " of pcl_sq cannot be loaded (" +
           (reason == nullptr ? "unknown reason" : reason) + "); install pcl_sq again";
  }
  return reinterpret_cast<Function*>(function);
}

} // namespace pcl_sq::detail
