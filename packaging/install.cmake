# SPDX-License-Identifier: GPL-2.0-or-later
# `cmake --install build --prefix <prefix>`: a folder that works without the repository, and wherever it is moved to.
# `cpack -G DEB` in build/: the same as a package for the Debian that it is built on.

# share/shearbox is laid out as the repository is, so that decks and tools find each other the same way in both.
install(TARGETS lmp_cdem RUNTIME DESTINATION bin)
install(TARGETS cdemplugin cdemstyles LIBRARY DESTINATION lib/shearbox)
install(DIRECTORY input DESTINATION share/shearbox)
install(DIRECTORY tools/shearbox_tools DESTINATION share/shearbox/tools PATTERN __pycache__ EXCLUDE PATTERN .* EXCLUDE)
install(PROGRAMS tools/shearbox DESTINATION share/shearbox/tools)
install(FILES tools/shearbox.py DESTINATION share/shearbox/tools)
install(FILES LICENSE CITATION.cff DESTINATION share/shearbox)
file(MAKE_DIRECTORY "${CMAKE_BINARY_DIR}/generated")
file(CREATE_LINK ../share/shearbox/tools/shearbox "${CMAKE_BINARY_DIR}/generated/shearbox" SYMBOLIC)
install(FILES "${CMAKE_BINARY_DIR}/generated/shearbox" DESTINATION bin)
install(FILES packaging/modulefile DESTINATION share/shearbox/modulefiles/shearbox RENAME ${PROJECT_VERSION})
install(FILES "${CMAKE_BINARY_DIR}/manual/man/shearbox.1" DESTINATION share/man/man1 OPTIONAL) # where tools/manual was run

# --- the Debian package ---------------------------------------------------------------------------
# Only with Debian's own LAMMPS, whose package has another name in each release.
file(REAL_PATH "${LAMMPS_LIBRARY}" library)
execute_process(COMMAND dpkg-query --search "${library}" OUTPUT_VARIABLE owner RESULT_VARIABLE failed ERROR_QUIET)
if(failed)
  return()
endif()
string(REGEX MATCH "^[^:]+" liblammps "${owner}")
execute_process(COMMAND dpkg-query --show --showformat "\${Version}" ${liblammps} OUTPUT_VARIABLE liblammps_version)

install(FILES packaging/debian/copyright DESTINATION share/doc/shearbox)
cmake_host_system_information(RESULT debian QUERY DISTRIB_INFO)

set(CPACK_PACKAGE_NAME shearbox)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "direct shear test of sand by the distinct element method, in LAMMPS")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Decks of the whole test, the program lmp_cdem, which is LAMMPS with the contact law,
and the command shearbox, which runs tests and reports on shear strength and dilatancy.")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE "1~debian${debian_VERSION_ID}")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The Shearbox authors")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# The library's file has the same name in all versions of LAMMPS, but its C++ interface changes: the program runs with that
# one alone that it was built against.
string(JOIN ", " CPACK_DEBIAN_PACKAGE_DEPENDS "${liblammps} (= ${liblammps_version})" openmpi-bin
  python3 python3-numpy python3-scipy python3-matplotlib python3-jinja2 python3-pil python3-rich)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-argcomplete, python3-pandas") # completion; shearbox.py
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "ffmpeg, python3-vtk9") # shearbox film, shearbox export
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
  "${CMAKE_CURRENT_SOURCE_DIR}/packaging/debian/postinst" "${CMAKE_CURRENT_SOURCE_DIR}/packaging/debian/prerm")
include(CPack)
