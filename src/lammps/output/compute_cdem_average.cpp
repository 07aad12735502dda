// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/compute_cdem_average.h"

#include "update.h"

using namespace LAMMPS_NS;

ComputeCDEMAverage::ComputeCDEMAverage(LAMMPS *lmp, int narg, char **arg)
    : Compute(lmp, narg, arg),
      fields(lmp, groupbit, {lmp, fmt::format("Compute cdem/average {}", id), narg, arg, 3}, arg),
      values(fields.columns()) {
  vector_flag = 1;
  extvector = 0;
  size_vector = fields.columns();
  vector = values.data();
}

void ComputeCDEMAverage::init() { fields.init(); }

void ComputeCDEMAverage::compute_vector() {
  invoked_vector = update->ntimestep;
  values = fields.rows(1, 1).front();
  vector = values.data();
}
