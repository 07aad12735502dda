// SPDX-License-Identifier: GPL-2.0-or-later
#include "guard.h"

#include "fix_cdem_integrate.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;

namespace {
constexpr double LARGEST_SHARE = 0.1; // of the smallest radius, in one step
}

void Guard::begin(double smallest_radius) {
  allowed = LARGEST_SHARE * smallest_radius;
  rescue.clear();
  keep();
}

// Of the centre in a step; INFINITY if anything about the grain is not a number.
double Guard::moved(int i) const {
  const double *const x = atom->x[i], *const v = atom->v[i], *const f = atom->f[i];
  const double way = update->dt * std::hypot(v[0], v[1]);
  const double all = way + x[0] + x[1] + atom->omega[i][2] + f[0] + f[1] + atom->torque[i][2];
  return std::isfinite(all) ? way : INFINITY;
}

void Guard::check() {
  struct {
    double moved;
    int rank;
  } mine{0, comm->me}, worst;
  int i_worst = -1;
  for (int i = 0; i < atom->nlocal; i++)
    if (const double way = moved(i); way > mine.moved) {
      mine.moved = way;
      i_worst = i;
    }
  MPI_Allreduce(&mine, &worst, 1, MPI_DOUBLE_INT, MPI_MAXLOC, world);
  if (suspects(worst.moved))
    fail(worst.rank, i_worst);
}

void Guard::keep() {
  check();
  if (!file.empty())
    rescue.take();
}

void Guard::fail(int owner, int worst) {
  tagint tag = owner == comm->me ? atom->tag[worst] : 0;
  double way = owner == comm->me ? moved(worst) : 0;
  MPI_Bcast(&tag, 1, MPI_LMP_TAGINT, owner, world);
  MPI_Bcast(&way, 1, MPI_DOUBLE, owner, world);

  std::string what = fmt::format("Fix cdem/integrate: at step {} atom {} ", update->ntimestep, tag);
  if (std::isfinite(way))
    what += fmt::format("moves by {:.3g} m in one step, more than a tenth of the smallest disc's radius, {:.3g} m: the "
                        "run is unstable, or too fast for its time step. ",
                        way, allowed);
  else
    what += "has a position, velocity or force that is not a finite number. ";
  what += cause();
  if (const bigint step = file.empty() ? -1 : rescue.write(file); step >= 0)
    what += fmt::format(" The state of step {} is in {}.", step, file);
  error->all(FLERR, what);
}

std::string Guard::cause() const {
  const double limit = FixCDEMIntegrate::find(lmp)->compute_scalar();
  if (update->dt > limit)
    return fmt::format("The time step {:.4g} s is beyond the stability limit {:.4g} s of this scene: take a smaller "
                       "one, or 'dt auto'.",
                       update->dt, limit);
  return fmt::format("The time step {:.4g} s is within the stability limit {:.4g} s of this scene: look for grains that "
                     "overlap or are too fast at the start, for walls or forces that drive them, or too light a lid.",
                     update->dt, limit);
}
