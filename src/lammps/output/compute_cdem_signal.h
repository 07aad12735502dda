// SPDX-License-Identifier: GPL-2.0-or-later
// compute ID all cdem/signal
//
// Whether the program has been sent the signal SIGUSR1 since the first such compute was made: 1, or 0. Batch systems
// send it some time before a job's limit, mpirun passes it on to its ranks, and without this compute it ends a program.
//
// For example, to end a run at the next multiple of 1000 steps, all ranks at the same one:
//
//   compute asked all cdem/signal
//   variable asked equal c_asked
//   fix end all halt 1000 v_asked > 0.5 error continue message no
//
// Scalar: 1 on all ranks if any of them has been sent it, else 0. The group must be all.
#pragma once

#include "compute.h"

namespace LAMMPS_NS {

class ComputeCDEMSignal : public Compute {
public:
  ComputeCDEMSignal(LAMMPS *, int, char **);
  void init() override {}
  double compute_scalar() override;
};

} // namespace LAMMPS_NS
