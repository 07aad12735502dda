// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/compute_cdem_discs.h"

#include "contacts/pair_cdem.h"
#include "grains/fix_cdem_grains.h"

#include "atom.h"
#include "error.h"
#include "force.h"
#include "update.h"

using namespace LAMMPS_NS;

ComputeCDEMDiscs::ComputeCDEMDiscs(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg) {
  if (narg != 3)
    error->all(FLERR, "Compute cdem/discs {}: unknown argument {}; it takes none", id, arg[3]);
  local_flag = 1;
  size_local_cols = 7;
  size_local_rows = 0;
}

void ComputeCDEMDiscs::init() {
  pair = dynamic_cast<PairCDEM *>(force->pair);
  if (!pair)
    error->all(FLERR, "Compute cdem/discs {} needs pair_style cdem", id);
  grains = FixCDEMGrains::find(lmp); // the pair style has seen that there is one
}

void ComputeCDEMDiscs::compute_local() {
  invoked_local = update->ntimestep;
  discs.clear();
  for (const auto &[i, number, x, y, radius] : pair->report.discs()) {
    if (!(atom->mask[i] & groupbit))
      continue;
    discs.add(static_cast<double>(atom->tag[i]));
    discs.add(number);
    discs.add(x);
    discs.add(y);
    discs.add(radius);
    discs.add(grains->angle(i));
    discs.add(atom->type[i]);
  }
  array_local = discs.rows(size_local_cols);
  size_local_rows = discs.size();
}

double ComputeCDEMDiscs::memory_usage() { return discs.memory_usage(); }
