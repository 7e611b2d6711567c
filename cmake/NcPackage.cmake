# SPDX-License-Identifier: Apache-2.0
# The Debian packages libnc1, libnc-dev, ncrtd and nc-tools, one CPack component each:
#   cd build/release && cpack            (docs/packaging.md; scripts/prove-packages installs and uses them)
# Files that only a package has (units, /etc/nc, man pages) are EXCLUDE_FROM_ALL, because `cmake --install` must not write outside its prefix.
include(${CMAKE_SOURCE_DIR}/libnc/cmake/abi.cmake)  # NC_ABI
find_program(NC_DPKG_DEB dpkg-deb)
if(NOT NC_DPKG_DEB OR NOT TARGET nc_shared OR NOT TARGET ncrtd OR NOT TARGET ncsim)
  return()
endif()

set(NC_PACKAGE_MAINTAINER "libnc contributors <libnc@example.org>" CACHE STRING "Maintainer field of the packages")
set(NC_PACKAGE_RELEASE 1 CACHE STRING "Debian revision of the packages")
set(nc_packaging ${CMAKE_SOURCE_DIR}/packaging)
set(nc_staged ${CMAKE_BINARY_DIR}/packaging)
set(nc_package_version ${PROJECT_VERSION}-${NC_PACKAGE_RELEASE})

# nc_package_file(COMPONENT DESTINATION FILE...): installs files with the mode rw-r--r--.
function(nc_package_file component destination)
  install(FILES ${ARGN} DESTINATION ${destination} COMPONENT ${component} EXCLUDE_FROM_ALL
          PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
endfunction()

# ---- /etc/nc: every configuration and ladder program; the configurations get the folder of part programs of the package ----
file(GLOB nc_configurations CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/etc/*.toml ${CMAKE_SOURCE_DIR}/etc/*.il)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${nc_configurations})
set(nc_conffiles "")
foreach(file IN LISTS nc_configurations)
  cmake_path(GET file FILENAME name)
  string(APPEND nc_conffiles "/etc/nc/${name}\n")
  if(name MATCHES "\\.toml$")
    file(READ ${file} text)
    string(REPLACE "programs = \"../examples/parts\"" "programs = \"/usr/share/nc/parts\"" text "${text}")
    set(file ${nc_staged}/etc/${name})
    file(WRITE ${file} "${text}")
  endif()
  nc_package_file(ncrtd /etc/nc ${file})
endforeach()

# ---- the other files ----
file(GLOB nc_parts CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/examples/parts/*)
nc_package_file(ncrtd share/nc/parts ${nc_parts})
file(GLOB nc_examples CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/examples/*.c)
nc_package_file(libnc_dev share/doc/libnc-dev/examples ${nc_examples})
nc_package_file(libnc_dev share/doc/libnc-dev ${CMAKE_SOURCE_DIR}/docs/embedding.md)

nc_package_file(ncrtd /lib/systemd/system ${nc_packaging}/systemd/ncrtd.service)
set(nc_units ncrtd.service)
nc_package_file(ncrtd share/man/man8 ${nc_packaging}/man/ncrtd.8)
nc_package_file(ncrtd share/man/man5 ${nc_packaging}/man/ncrtd.toml.5)
nc_package_file(ncrtd share/man/man1 ${nc_packaging}/man/ncctl.1)
nc_package_file(ncrtd share/bash-completion/completions ${nc_packaging}/completion/ncctl)
nc_package_file(nc_tools share/man/man1 ${nc_packaging}/man/ncsim.1)
set(nc_manual_dds "")
if(TARGET ncdds)
  nc_package_file(ncrtd /lib/systemd/system ${nc_packaging}/systemd/ncdds.service)
  list(PREPEND nc_units ncdds.service)    # stopped before ncrtd
  nc_package_file(ncrtd share/man/man8 ${nc_packaging}/man/ncdds.8)
  nc_package_file(ncrtd share/nc/dds ${CMAKE_SOURCE_DIR}/dds/nc_dds.idl ${CMAKE_SOURCE_DIR}/dds/nc_dds.py ${CMAKE_SOURCE_DIR}/dds/nc_trace.py)
  nc_package_file(ncrtd share/man/man8 ${nc_packaging}/man/nc-keys.8)
  nc_package_file(ncrtd share/bash-completion/completions ${nc_packaging}/completion/nc-keys)
  configure_file(${nc_packaging}/systemd/ncdds-secured.conf ${nc_staged}/dds/secured.conf COPYONLY)
  nc_package_file(ncrtd share/nc/dds ${nc_staged}/dds/secured.conf)
  set(nc_manual_dds "\nncdds publishes over DDS what it does.")
endif()
set(nc_manual_mon "")
if(TARGET ncmon)
  set(nc_manual_mon "\nncmon watches a running ncrtd from a terminal.")
  nc_package_file(nc_tools share/man/man1 ${nc_packaging}/man/ncmon.1)
endif()
# A document leads to no other that its package does not have (tests/install/package_test.sh).
foreach(name packaging ladder signals modbus gpio canopen homing safety restart connecting-a-machine services security dds macros parameters system-variables functions cycles motion motion-optimal high-accuracy benchmarks)
  if(EXISTS ${CMAKE_SOURCE_DIR}/docs/${name}.md)
    nc_package_file(ncrtd share/doc/ncrtd ${CMAKE_SOURCE_DIR}/docs/${name}.md)
  endif()
endforeach()
foreach(name trace motion motion-optimal high-accuracy macros parameters system-variables ladder)
  nc_package_file(nc_tools share/doc/nc-tools ${CMAKE_SOURCE_DIR}/docs/${name}.md)
endforeach()

# ---- control files ----
list(JOIN nc_units " " NC_UNITS)
foreach(script postinst prerm postrm)
  configure_file(${nc_packaging}/debian/ncrtd.${script}.in ${nc_staged}/ncrtd/${script} @ONLY FILE_PERMISSIONS
                 OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
endforeach()
file(WRITE ${nc_staged}/ncrtd/conffiles "${nc_conffiles}")
# A program that is linked against this version needs at least this version.
set(nc_library_package libnc${NC_ABI})
file(WRITE ${nc_staged}/${nc_library_package}/shlibs "libnc ${NC_ABI} ${nc_library_package} (>= ${PROJECT_VERSION})\n")
file(WRITE ${nc_staged}/${nc_library_package}/triggers "activate-noawait ldconfig\n")

# ---- CPack ----
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME libnc)
set(CPACK_PACKAGE_VENDOR "libnc contributors")
set(CPACK_PACKAGE_CONTACT ${NC_PACKAGE_MAINTAINER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")    # every package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL ${nc_library_package} libnc_dev ncrtd nc_tools)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${NC_PACKAGE_RELEASE})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_COMPRESSION_TYPE gzip)    # finish_debs.cmake packs them again with xz, which takes long
set(CPACK_PRE_BUILD_SCRIPTS ${nc_packaging}/finish.cmake)
set(CPACK_POST_BUILD_SCRIPTS ${nc_packaging}/finish_debs.cmake)
set(CPACK_NC_PACKAGING ${nc_packaging})
set(CPACK_NC_SOURCE ${CMAKE_SOURCE_DIR})
set(CPACK_NC_STRIP ${CMAKE_STRIP})

set(CPACK_DEBIAN_LIBNC${NC_ABI}_PACKAGE_NAME ${nc_library_package})
set(CPACK_DEBIAN_LIBNC${NC_ABI}_PACKAGE_SECTION libs)
set(CPACK_NC_MULTIARCH_${nc_library_package} same)
set(CPACK_DEBIAN_LIBNC${NC_ABI}_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIBNC${NC_ABI}_PACKAGE_CONTROL_EXTRA ${nc_staged}/${nc_library_package}/shlibs ${nc_staged}/${nc_library_package}/triggers)
set(CPACK_DEBIAN_LIBNC${NC_ABI}_DESCRIPTION "open CNC control - shared library
libnc reads the NC programs of CNC machines as their controllers' manuals
say, and turns them into one set of axis positions per servo cycle. It
allocates nothing and calls no operating system, so that it can run in a
hard real-time scan.")

set(CPACK_DEBIAN_LIBNC_DEV_PACKAGE_NAME libnc-dev)
set(CPACK_DEBIAN_LIBNC_DEV_PACKAGE_SECTION libdevel)
set(CPACK_NC_MULTIARCH_libnc-dev same)
set(CPACK_DEBIAN_LIBNC_DEV_PACKAGE_DEPENDS "${nc_library_package} (= ${nc_package_version})")
set(CPACK_DEBIAN_LIBNC_DEV_DESCRIPTION "open CNC control - development files
libnc reads the NC programs of CNC machines as their controllers' manuals
say, and turns them into one set of axis positions per servo cycle.

This package holds the C headers, the static library, the pkg-config file
and the CMake package, with an example.")

set(CPACK_DEBIAN_NCRTD_PACKAGE_NAME ncrtd)
set(CPACK_DEBIAN_NCRTD_PACKAGE_SECTION misc)
set(CPACK_DEBIAN_NCRTD_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_NCRTD_PACKAGE_DEPENDS adduser)
set(CPACK_DEBIAN_NCRTD_PACKAGE_RECOMMENDS "nc-tools, openssl")
set(CPACK_DEBIAN_NCRTD_PACKAGE_CONTROL_EXTRA ${nc_staged}/ncrtd/postinst ${nc_staged}/ncrtd/prerm ${nc_staged}/ncrtd/postrm
    ${nc_staged}/ncrtd/conffiles)
set(CPACK_DEBIAN_NCRTD_DESCRIPTION "open CNC control - runtime daemon
ncrtd runs NC programs on a machine in real time: scan, ladder, fieldbus
and the handshake of auxiliary functions. As installed it drives a
simulated machining centre.${nc_manual_dds}

The services are neither enabled nor started by the installation.")

set(CPACK_DEBIAN_NC_TOOLS_PACKAGE_NAME nc-tools)
set(CPACK_DEBIAN_NC_TOOLS_PACKAGE_SECTION misc)
set(CPACK_NC_MULTIARCH_nc-tools foreign)
set(CPACK_DEBIAN_NC_TOOLS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_NC_TOOLS_PACKAGE_RECOMMENDS libcairo2)    # loaded when a picture is drawn
set(CPACK_DEBIAN_NC_TOOLS_DESCRIPTION "open CNC control - tools for NC programs
ncsim checks, traces, times and plots NC programs without a machine.${nc_manual_mon}")
include(CPack)
