# SPDX-License-Identifier: Apache-2.0
# Run by CPack when the packages are made: what CPack 3.25 cannot say. The Multi-Arch field, and no maintainer scripts for the
# library: its trigger runs ldconfig.
find_program(dpkg_deb dpkg-deb REQUIRED)
foreach(package IN LISTS CPACK_PACKAGE_FILES)
  cmake_path(GET package FILENAME name)
  string(REGEX REPLACE "_.*" "" name ${name})
  set(root ${CPACK_TEMPORARY_DIRECTORY}/finish/${name})
  file(REMOVE_RECURSE ${root})
  file(MAKE_DIRECTORY ${CPACK_TEMPORARY_DIRECTORY}/finish)
  execute_process(COMMAND ${dpkg_deb} --raw-extract ${package} ${root} COMMAND_ERROR_IS_FATAL ANY)
  file(READ ${root}/DEBIAN/control control)
  string(STRIP "${control}" control)    # CPack leaves an empty line at the end
  if(CPACK_NC_MULTIARCH_${name} AND NOT control MATCHES "\nMulti-Arch:")
    file(WRITE ${root}/DEBIAN/control "${control}\nMulti-Arch: ${CPACK_NC_MULTIARCH_${name}}\n")
  endif()
  if(EXISTS ${root}/DEBIAN/shlibs)
    file(REMOVE ${root}/DEBIAN/postinst ${root}/DEBIAN/postrm)
  endif()
  execute_process(COMMAND ${dpkg_deb} --root-owner-group -Zxz --build ${root} ${package} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endforeach()
