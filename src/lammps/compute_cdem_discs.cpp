// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_cdem_discs.h"

#include "fix_cdem_integrate.h"

#include "atom.h"
#include "error.h"
#include "update.h"

#include <array>

using namespace LAMMPS_NS;

namespace {

struct Disc {
  double x, y, radius;
};

// The discs of a grain: one, as large as the grain.
std::array<Disc, 1> discs_of(const Atom &atom, int i) { return {{{atom.x[i][0], atom.x[i][1], atom.radius[i]}}}; }

} // namespace

ComputeCDEMDiscs::ComputeCDEMDiscs(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg) {
  if (narg != 3)
    error->all(FLERR, "Compute cdem/discs {}: unknown argument {}; it takes none", id, arg[3]);
  if (!atom->sphere_flag)
    error->all(FLERR, "Compute cdem/discs {} needs atom_style sphere", id);
  local_flag = 1;
  size_local_cols = 7;
  size_local_rows = 0;
}

void ComputeCDEMDiscs::init() {
  integrate = FixCDEMIntegrate::find(lmp);
  if (!integrate)
    error->all(FLERR, "Compute cdem/discs {} needs a fix cdem/integrate, which knows the angles", id);
}

void ComputeCDEMDiscs::compute_local() {
  invoked_local = update->ntimestep;
  discs.clear();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit))
      continue;
    const double angle = integrate->state[i][FixCDEMIntegrate::ANGLE];
    double number = 0;
    for (const Disc &d : discs_of(*atom, i)) {
      for (double value :
           {static_cast<double>(atom->tag[i]), number, d.x, d.y, d.radius, angle, static_cast<double>(atom->type[i])})
        discs.add(value);
      number++;
    }
  }
  array_local = discs.rows(size_local_cols);
  size_local_rows = discs.size();
}

double ComputeCDEMDiscs::memory_usage() { return discs.memory_usage(); }
