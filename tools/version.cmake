# SPDX-License-Identifier: GPL-2.0-or-later
# Writes the header OUTPUT with the project's VERSION and the git commit of SOURCE; touches it only when that changes.
cmake_minimum_required(VERSION 3.22)
execute_process(COMMAND git -c "safe.directory=${SOURCE}" describe --always --dirty --abbrev=10 --exclude=*
  WORKING_DIRECTORY "${SOURCE}" OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit "no git")
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "#define SHEARBOX_VERSION \"@VERSION@ (@commit@)\"\n" @ONLY)
