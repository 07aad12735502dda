// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

// What differs between LAMMPS versions, and nothing else: the only file that asks for the version.
// LAMMPS_VERSION_NUMBER (20210929 for 29Sep2021) comes from the build, which reads it in LAMMPS's version.h.

#include "comm.h"
#include "fix.h"
#include "lammps.h"
#include "modify.h"
#include "neigh_request.h"
#include "neighbor.h"
#include "pair.h"

#include <string>

#define SHEARBOX_LAMMPS_2022 (LAMMPS_VERSION_NUMBER >= 20220623) // the first stable version with the new interfaces

namespace Shearbox {

using namespace LAMMPS_NS;

// A list that has each pair once (with newton off: once on each of the two ranks of its atoms) and takes its cutoff
// from the radii. `instance` is the style's instance_me.
inline void request_half_size_list(LAMMPS *lmp, Pair *pair, [[maybe_unused]] int instance) {
#if SHEARBOX_LAMMPS_2022
  lmp->neighbor->add_request(pair, NeighConst::REQ_SIZE);
#else
  const int id = lmp->neighbor->request(pair, instance);
  lmp->neighbor->requests[id]->size = 1;
#endif
}

// Sends values of own atoms to their ghosts, by the caller's pack_forward_comm and unpack_forward_comm.
inline void forward_comm(LAMMPS *lmp, Fix *fix) {
#if SHEARBOX_LAMMPS_2022
  lmp->comm->forward_comm(fix);
#else
  lmp->comm->forward_comm_fix(fix);
#endif
}

inline void forward_comm(LAMMPS *lmp, Pair *pair) {
#if SHEARBOX_LAMMPS_2022
  lmp->comm->forward_comm(pair);
#else
  lmp->comm->forward_comm_pair(pair);
#endif
}

// Null if there is no such fix.
inline Fix *fix_by_id(LAMMPS *lmp, const std::string &id) {
#if SHEARBOX_LAMMPS_2022
  return lmp->modify->get_fix_by_id(id);
#else
  const int i = lmp->modify->find_fix(id);
  return i < 0 ? nullptr : lmp->modify->fix[i];
#endif
}

} // namespace Shearbox
