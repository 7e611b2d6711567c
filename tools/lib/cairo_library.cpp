// SPDX-License-Identifier: Apache-2.0
// See cairo_library.hpp.
#include "tools/lib/cairo_library.hpp"

#include <dlfcn.h>

#include <mutex>

namespace nc::tools {

#define NC_CAIRO_POINTER(name) decltype(&::name) name = nullptr;
NC_FOR_EACH_CAIRO_FUNCTION(NC_CAIRO_POINTER)
#undef NC_CAIRO_POINTER

namespace {

constexpr const char* kCairo = "libcairo.so.2";  // the name that its releases have kept since 2005

/// The address as the type of the function, which POSIX allows for what dlsym() returns.
template <class Function>
bool find(void* library, const char* name, Function* function, std::string* error) {
  void* const found = dlsym(library, name);
  if (found == nullptr) {
    if (error) *error = std::string(kCairo) + " has no " + name;
    return false;
  }
  *function = reinterpret_cast<Function>(found);
  return true;
}

bool find_all(void* library, std::string* error) {
#define NC_CAIRO_FIND(name) \
  if (!find(library, #name, &name, error)) return false;
  NC_FOR_EACH_CAIRO_FUNCTION(NC_CAIRO_FIND)
#undef NC_CAIRO_FIND
  return true;
}

}  // namespace

bool load_cairo(std::string* error) {
  static std::mutex one_at_a_time;
  static bool loaded = false;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  if (loaded) return true;
  void* const library = dlopen(kCairo, RTLD_NOW | RTLD_LOCAL);  // never closed: the pointers stay
  if (library == nullptr) {
    const char* const why = dlerror();
    if (error) *error = std::string("pictures need cairo: ") + (why != nullptr ? why : kCairo);
    return false;
  }
  loaded = find_all(library, error);
  if (!loaded) dlclose(library);
  return loaded;
}

}  // namespace nc::tools
