// SPDX-License-Identifier: GPL-2.0-or-later
#include "host/version_check.h"

#include "library.h"
#include "lmptype.h"
#include "version_cdem.h"

#include <dlfcn.h>
#include <mpi.h>
#include <sstream>

namespace {

#ifdef OPEN_MPI
constexpr bool OPEN_MPI_HERE = true;
#else
constexpr bool OPEN_MPI_HERE = false; // MPICH, Intel MPI, MVAPICH: they can stand in for one another
#endif

std::string name_of_running_mpi() {
  const auto tell =
      reinterpret_cast<decltype(&MPI_Get_library_version)>(dlsym(RTLD_DEFAULT, "MPI_Get_library_version"));
  if (!tell)
    return "another MPI";
  char text[MPI_MAX_LIBRARY_VERSION_STRING + 1] = "";
  int length = 0;
  tell(text, &length);
  std::string line, name;
  std::getline(std::istringstream(text), line);
  std::istringstream words(line);
  for (std::string word; words >> word;)
    name += (name.empty() ? "" : " ") + word;
  return name;
}

// Open MPI has addresses for handles, the others numbers: nothing fails until they are used. MPI's functions come from
// the program, but Open MPI's handles would silently come from a second library, which the dynamic linker loads for us.
std::string mpi_mismatch() {
  const std::string compiled =
      std::string("Shearbox was compiled with ") + (OPEN_MPI_HERE ? "Open MPI" : "MPICH or its like");
  if (!lammps_config_has_mpi_support())
    return compiled + ", but this LAMMPS has no MPI: it needs a LAMMPS that is built with MPI";
  if (bool(dlsym(RTLD_DEFAULT, "ompi_mpi_comm_world")) != OPEN_MPI_HERE)
    return compiled + ", but this LAMMPS runs with " + name_of_running_mpi() +
           ": compile it again with the MPI of this LAMMPS";
  return "";
}

} // namespace

std::string Shearbox::version() { return SHEARBOX_VERSION; }

std::string Shearbox::mismatch(void *lmp) {
  const int running = lammps_version(lmp);
  if (running != LAMMPS_VERSION_NUMBER)
    return "Shearbox was compiled for LAMMPS " + std::to_string(LAMMPS_VERSION_NUMBER) + ", but this is LAMMPS " +
           std::to_string(running) + ": compile it again with the headers of this LAMMPS";
  const int id_bytes = lammps_extract_setting(lmp, "tagint");
  if (id_bytes != int(sizeof(LAMMPS_NS::tagint)))
    return "Shearbox was compiled for atom ids of " + std::to_string(8 * sizeof(LAMMPS_NS::tagint)) +
           " bits, but those of this LAMMPS have " + std::to_string(8 * id_bytes) +
           ": compile it again with -DLAMMPS_SIZES=" + (id_bytes == 8 ? "BIGBIG" : "SMALLBIG");
  return mpi_mismatch();
}
