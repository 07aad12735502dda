// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_cdem_energy.h"

#include "fix_cdem_shape.h"
#include "pair_cdem.h"

#include "atom.h"
#include "error.h"
#include "force.h"
#include "update.h"

#include <numeric>

using namespace LAMMPS_NS;

ComputeCDEMEnergy::ComputeCDEMEnergy(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg) {
  if (narg != 3)
    error->all(FLERR, "Compute cdem/energy {}: unknown argument {}; it takes none", id, arg[3]);
  if (!atom->sphere_flag)
    error->all(FLERR, "Compute cdem/energy {} needs atom_style sphere", id);
  scalar_flag = vector_flag = 1;
  extscalar = extvector = 1;
  size_vector = NPARTS;
  vector = energy.data();
}

void ComputeCDEMEnergy::init() {
  pair = dynamic_cast<PairCDEM *>(force->pair);
  if (!pair)
    error->all(FLERR, "Compute cdem/energy {} needs pair_style cdem", id);
  inertia.assign(1, 0);
  for (int type = 1; type <= atom->ntypes; type++)
    inertia.push_back(FixCDEMShape::shape(lmp, type).inertia());
}

void ComputeCDEMEnergy::compute_vector() {
  invoked_vector = update->ntimestep;
  std::array<double, NPARTS> mine{};
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit))
      continue;
    const double m = atom->rmass[i], r = atom->radius[i], omega = atom->omega[i][2];
    const double *const v = atom->v[i];
    mine[TRANSLATION] += 0.5 * m * (v[0] * v[0] + v[1] * v[1]);
    mine[ROTATION] += 0.5 * (inertia[atom->type[i]] * m * r * r) * omega * omega;
  }
  mine[SPRINGS] = pair->elastic_energy();
  MPI_Allreduce(mine.data(), energy.data(), NPARTS, MPI_DOUBLE, MPI_SUM, world);
}

double ComputeCDEMEnergy::compute_scalar() {
  compute_vector();
  invoked_scalar = update->ntimestep;
  scalar = std::accumulate(energy.begin(), energy.end(), 0.0);
  return scalar;
}
