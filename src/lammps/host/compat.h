// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

// What differs between LAMMPS versions, and nothing else: the only file that asks for the version.
// LAMMPS_VERSION_NUMBER (20210929 for 29Sep2021) comes from the build, which reads it in LAMMPS's version.h.

#include "atom.h"
#include "comm.h"
#include "fix.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "neigh_request.h"
#include "neighbor.h"
#include "pair.h"

#include <cstring>
#include <string>
#include <vector>

#define SHEARBOX_LAMMPS_2022 (LAMMPS_VERSION_NUMBER >= 20220623) // the first stable version with the new interfaces

namespace Shearbox {

using namespace LAMMPS_NS;

// Whether the command plugin loads run styles: 4Feb2025 says "not yet implemented", 22Jul2025 does.
inline constexpr bool LOADER_HAS_RUN_STYLES = LAMMPS_VERSION_NUMBER >= 20250722;

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

// Whether atoms have what atom_style sphere gives them. 4Jul2026 has no Atom::sphere_flag any more.
inline bool is_sphere(const Atom *atom) {
  return atom->radius_flag && atom->rmass_flag && atom->omega_flag && atom->torque_flag;
}

// How many fixes act on forces after they are computed. Protected in newer versions.
inline int fixes_after_forces(const Modify *all) {
  struct Look : Modify {
    using Modify::n_post_force;
  };
  return all->*&Look::n_post_force;
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

// The command of the deck that is being executed. LAMMPS tells nobody else.
inline std::string command_in_work(LAMMPS *lmp) {
  struct Look : Input {
    using Input::command;
  };
  const char *const command = lmp->input->*&Look::command;
  return command ? command : "";
}

// The ids of fixes of this style whose state a restart file has, and that no fix has taken. LAMMPS forgets them when
// the first run begins.
inline std::vector<std::string> states_left(LAMMPS *lmp, const char *style) {
  struct Look : Modify {
    using Modify::id_restart_global;
    using Modify::style_restart_global;
    using Modify::used_restart_global;
  };
  const Modify &all = *lmp->modify;
  std::vector<std::string> ids;
  for (int k = 0; k < all.nfix_restart_global; k++)
    if (!(all.*&Look::used_restart_global)[k] && strcmp((all.*&Look::style_restart_global)[k], style) == 0)
      ids.emplace_back((all.*&Look::id_restart_global)[k]);
  return ids;
}

// The group that comm_modify group leaves ghosts of, as an index; 0: all.
inline int group_of_ghosts(const Comm &comm) {
  struct Look : Comm {
    using Comm::bordergroup;
  };
  return comm.*&Look::bordergroup;
}

} // namespace Shearbox
