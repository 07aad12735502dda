# SPDX-License-Identifier: GPL-2.0-or-later
# build/liggghts_cdem.so: contact models and fixes for an unmodified LIGGGHTS, if its headers and library are there
# (Debian: libliggghts-dev).
find_path(LIGGGHTS_HEADERS granular_pair_style.h PATH_SUFFIXES liggghts DOC "headers of LIGGGHTS")
find_library(LIGGGHTS_LIBRARY liggghts DOC "libliggghts.so, built from the source of LIGGGHTS_HEADERS")
if(NOT LIGGGHTS_HEADERS OR NOT LIGGGHTS_LIBRARY)
  message(STATUS "no liggghts_cdem.so: LIGGGHTS is missing (Debian: libliggghts-dev)")
  return()
endif()
message(STATUS "LIGGGHTS: ${LIGGGHTS_LIBRARY}, headers ${LIGGGHTS_HEADERS}")

# LIGGGHTS makes lists of its models when it is built, which Debian does not ship. Ours are not in them, and of its own only
# the default surface is named in its headers.
set(lists "${CMAKE_BINARY_DIR}/generated/liggghts")
foreach(kind surface normal tangential cohesion rolling)
  file(CONFIGURE OUTPUT "${lists}/style_${kind}_model.h" CONTENT "")
endforeach()
file(CONFIGURE OUTPUT "${lists}/style_surface_model.h" CONTENT "#include \"surface_model_default.h\"\n")

file(GLOB liggghts_sources CONFIGURE_DEPENDS src/liggghts/*.cpp)
add_library(liggghts_cdem MODULE ${liggghts_sources})
set_target_properties(liggghts_cdem PROPERTIES PREFIX "" SUFFIX ".so" CXX_VISIBILITY_PRESET hidden)
target_include_directories(liggghts_cdem SYSTEM PRIVATE "${LIGGGHTS_HEADERS}" "${lists}")
target_link_libraries(liggghts_cdem PRIVATE shearbox_flags "${LIGGGHTS_LIBRARY}" MPI::MPI_CXX)
install(TARGETS liggghts_cdem LIBRARY DESTINATION lib/shearbox)
