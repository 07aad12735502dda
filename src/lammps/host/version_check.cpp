// SPDX-License-Identifier: GPL-2.0-or-later
#include "host/version_check.h"

#include "library.h"
#include "lmptype.h"
#include "version_cdem.h"

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
  return "";
}
