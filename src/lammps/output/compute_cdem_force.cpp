// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/compute_cdem_force.h"

#include "host/rank_sum.h"

#include "atom.h"
#include "error.h"
#include "group.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {
constexpr int AXES = 2;
}

ComputeCDEMForce::ComputeCDEMForce(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg) {
  if (narg == 3)
    error->all(FLERR, "Compute cdem/force {}: names of groups are missing", id);
  names.assign(arg + 3, arg + narg);
  find_parts();
  forces.resize(AXES * parts.size());
  vector = forces.data();
  vector_flag = 1;
  size_vector = static_cast<int>(forces.size());
  extvector = 1;
}

// Groups may be deleted and made anew, and then have other bits.
void ComputeCDEMForce::find_parts() {
  parts.clear();
  for (const std::string &name : names) {
    const int part = group->find(name);
    if (part < 0)
      error->all(FLERR, "Compute cdem/force {}: there is no group {}", id, name);
    parts.push_back(group->bitmask[part]);
  }
}

void ComputeCDEMForce::compute_vector() {
  invoked_vector = update->ntimestep;
  std::vector<cdem::ExactSum> sums(forces.size());
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit)
      for (std::size_t p = 0; p < parts.size(); p++)
        if (atom->mask[i] & parts[p])
          for (int axis = 0; axis < AXES; axis++)
            sums[AXES * p + axis].add(atom->f[i][axis]);

  std::vector<cdem::ExactSum::Words> words;
  for (const cdem::ExactSum &sum : sums)
    words.push_back(sum.words());
  Shearbox::add_ranks(words.data(), size_vector, world);
  for (int k = 0; k < size_vector; k++)
    vector[k] = cdem::ExactSum(words[k]).value();
}
