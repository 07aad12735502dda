// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/compute_cdem_limit.h"

#include "contacts/pair_cdem.h"
#include "motion/fix_cdem_integrate.h"

#include "error.h"
#include "update.h"

using namespace LAMMPS_NS;

ComputeCDEMLimit::ComputeCDEMLimit(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg) {
  if (narg != 3)
    error->all(FLERR, "Compute cdem/limit: unknown argument {}; it takes none", arg[3]);
  if (igroup != 0)
    error->all(FLERR, "Compute cdem/limit {}: the group must be all", id);
  scalar_flag = 1;
  extscalar = 0;
}

void ComputeCDEMLimit::init() { PairCDEM::needed_by("Compute cdem/limit", lmp); }

double ComputeCDEMLimit::compute_scalar() {
  invoked_scalar = update->ntimestep;
  scalar = FixCDEMIntegrate::find(lmp)->contact_limit();
  return scalar;
}
