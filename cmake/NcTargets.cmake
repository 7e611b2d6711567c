# SPDX-License-Identifier: Apache-2.0
# How the rooms around libnc (hal, runtime, tools, tests, bench) make their targets.

# nc_room_around(TARGET [FILES]): for a room around libnc. Several of its files are compiled as one source, since most of the compilation goes into headers that
# they have in common; so a name in an unnamed namespace occurs once in its folder. scripts/tidy compiles each file that has changed by itself, and
# finds an include that is missing. Under the sanitizers clang's precompiled headers of the standard library help once more; GCC 12 gives false
# warnings about std::string when it optimizes precompiled headers. Nor is a room optimized there: two fifths of its compilation went into that, and what
# takes long in the tests is libnc. FILES is how many are joined under the sanitizers, where it is another number; then a name in an unnamed namespace occurs
# once in the room.
function(nc_room_around target)
  if(NC_FILES_PER_SOURCE GREATER 1)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${NC_FILES_PER_SOURCE})
  endif()
  if(NOT NC_SANITIZE)
    return()
  endif()
  if(NC_FILES_PER_SOURCE GREATER 1 AND ARGC GREATER 1)
    set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE ${ARGV1})
  endif()
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <atomic> <charconv> <cmath> <functional> <map> <memory> <mutex> <optional>
                              <string> <string_view> <vector>)
  endif()
  target_compile_options(${target} PRIVATE $<$<CONFIG:Sanitize>:-O0>)
endfunction()

# In a release the programs leave out the functions of the rooms that they do not use, and with them libraries that a start would take time for (NC_WITHOUT_SERVICES
# below). An instrumented build keeps everything.
set(NC_DROPS_UNUSED OFF)
if(CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT NC_SANITIZE AND NOT NC_COVERAGE)
  set(NC_DROPS_UNUSED ON)
endif()

# nc_host_options(TARGET): ordinary hosted C++20 with the project's warnings.
function(nc_host_options target)
  set_target_properties(${target} PROPERTIES CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF
                        C_STANDARD 11 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF)
  get_target_property(type ${target} TYPE)
  if(NC_DROPS_UNUSED AND type STREQUAL "STATIC_LIBRARY")
    set(sections -ffunction-sections -fdata-sections)
  endif()
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wpedantic ${sections})
  if(NC_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# nc_link_rooms(TARGET VISIBILITY ROOM...): links those of the named room libraries that exist.
function(nc_link_rooms target visibility)
  foreach(room IN LISTS ARGN)
    if(TARGET ${room})
      target_link_libraries(${target} ${visibility} ${room})
    endif()
  endforeach()
endfunction()

# Uses Debian's library folder below any prefix: Debian searches it below /usr/local, too, and so every build tree can make the packages.
if(CMAKE_SYSTEM_NAME STREQUAL "Linux" AND CMAKE_LIBRARY_ARCHITECTURE AND EXISTS /etc/debian_version)
  option(NC_MULTIARCH_LIBDIR "Install libraries into lib/${CMAKE_LIBRARY_ARCHITECTURE} where it would be lib" ON)
  if(NC_MULTIARCH_LIBDIR AND CMAKE_INSTALL_LIBDIR STREQUAL "lib")
    set(CMAKE_INSTALL_LIBDIR lib/${CMAKE_LIBRARY_ARCHITECTURE})
    set(CMAKE_INSTALL_FULL_LIBDIR ${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR})
  endif()
endif()

# nc_program(NAME MAIN LIBS...): an installed executable from one file, if that file exists. All symbols are bound at start-up, so that none is
# looked up during a scan, and it depends only on the libraries that it uses. Which these are the linker says before it drops what is not used: so a program that
# offers no services has the property NC_WITHOUT_SERVICES, and is not linked with the libraries that only services need (runtime/CMakeLists.txt). If it comes to use
# one of them, it does not link.
function(nc_program name main)
  if(NOT EXISTS ${main})
    return()
  endif()
  add_executable(${name} ${main})
  nc_host_options(${name})
  target_link_options(${name} PRIVATE -Wl,--as-needed -Wl,-z,relro -Wl,-z,now)
  if(NC_DROPS_UNUSED)
    target_link_options(${name} PRIVATE -Wl,--gc-sections)
  endif()
  nc_link_rooms(${name} PRIVATE ${ARGN})
  if(name MATCHES "^nc(rtd|dds|ctl)$")
    set(component ncrtd)
  else()
    set(component nc_tools)
  endif()
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${component})
endfunction()

# nc_use_eigen(TARGET): for tests and benches that include private headers of libnc.
function(nc_use_eigen target)
  find_package(Eigen3 3.4 REQUIRED NO_MODULE)
  get_target_property(eigen_include Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
  target_include_directories(${target} SYSTEM PRIVATE ${eigen_include})
endfunction()
