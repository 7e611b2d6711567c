# SPDX-License-Identifier: Apache-2.0
# Build types, sanitizers and coverage: flags that must be the same for every target of one build tree.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug or Sanitize" FORCE)
endif()

# -g1 keeps function names and lines for backtraces of a release at a fraction of the size of -g.
set(CMAKE_C_FLAGS_RELEASE "-O2 -g1 -DNDEBUG")
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -g1 -DNDEBUG")
# A release is hardened as Debian hardens its own packages, because it reads files and sockets that others write. Executables are
# position-independent by default of the compilers; nc_program() and libnc.so add relro and binding at start-up. A firmware, which configures
# libnc/ alone, chooses for itself. tests/install/package_test.sh checks the packaged binaries.
set(NC_HARDENING "-fstack-protector-strong;-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2" CACHE STRING "Compiler options of a release against overflows of buffers")
add_compile_options("$<$<CONFIG:Release>:${NC_HARDENING}>")
set(CMAKE_C_FLAGS_DEBUG "-O0 -g3")
set(CMAKE_CXX_FLAGS_DEBUG "-O0 -g3")
# Assertions stay on under the sanitizers: they find the same kind of error earlier.
set(CMAKE_C_FLAGS_SANITIZE "-O1 -g1 -fno-omit-frame-pointer")
set(CMAKE_CXX_FLAGS_SANITIZE "-O1 -g1 -fno-omit-frame-pointer")

set(NC_SANITIZE "" CACHE STRING "Sanitizers for the whole tree, as in -fsanitize= (address,undefined or thread)")
option(NC_COVERAGE "Instrument for gcov" OFF)
option(NC_WERROR "Warnings are errors" ON)

if(NC_SANITIZE)
  add_compile_options(-fsanitize=${NC_SANITIZE} -fno-sanitize-recover=all)
  # A host in C may pass any integer where the API has an enumeration, and the library refuses those that are not valid. Without -fstrict-enums the
  # compilers assume nothing about the range of an enumeration, so to read such a value is no fault.
  if(NC_SANITIZE MATCHES "undefined")
    add_compile_options(-fno-sanitize=enum)
    # Clang before 17 cannot write what its check of function pointers wants in front of the parts of a coroutine ("Cannot represent a difference
    # across sections"; motion/optimal/work.hpp has coroutines). GCC has no such check.
    if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
      add_compile_options(-fno-sanitize=function)
    endif()
  endif()
  add_link_options(-fsanitize=${NC_SANITIZE})
  # The examples are linked by the C compiler, but libnc.a in them needs the C++ part of clang's sanitizers.
  if(CMAKE_C_COMPILER_ID MATCHES "Clang")
    add_link_options(-fsanitize-link-c++-runtime)
    # Some sixty programs are linked, each with most of the tree; LLVM's linker takes a quarter of the time.
    find_program(NC_LLD ld.lld)
    if(NC_LLD)
      add_link_options(-fuse-ld=lld)
    endif()
  endif()
endif()
if(NC_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "NC_FUZZ needs clang: use the preset `asan` (scripts/fuzz does)")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
if(NC_COVERAGE)
  add_compile_options(--coverage -fprofile-update=atomic)
  add_link_options(--coverage)
endif()
# No fast-math anywhere, and no contraction to fused multiply-add, so that a trace has the same bytes on every computer.
add_compile_options(-ffp-contract=off)
