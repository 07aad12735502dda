// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/compute_cdem_signal.h"

#include "error.h"
#include "update.h"

#include <csignal>
#include <mpi.h>

using namespace LAMMPS_NS;

namespace {

volatile std::sig_atomic_t sent = 0;

void note(int) { sent = 1; }

} // namespace

ComputeCDEMSignal::ComputeCDEMSignal(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg) {
  if (narg != 3)
    error->all(FLERR, "Compute cdem/signal: unknown argument {}; it takes none", arg[3]);
  if (igroup != 0)
    error->all(FLERR, "Compute cdem/signal {}: the group must be all", id);
  scalar_flag = 1;
  extscalar = 0;
  std::signal(SIGUSR1, note);
}

double ComputeCDEMSignal::compute_scalar() {
  invoked_scalar = update->ntimestep;
  const double mine = sent;
  MPI_Allreduce(&mine, &scalar, 1, MPI_DOUBLE, MPI_MAX, world);
  return scalar;
}
