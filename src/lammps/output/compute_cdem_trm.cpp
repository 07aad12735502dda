// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/compute_cdem_trm.h"

#include "grains/fix_cdem_grains.h"
#include "host/compat.h"
#include "host/rank_sum.h"
#include "output/fix_cdem_trm.h"

#include "atom.h"
#include "error.h"
#include "group.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;

ComputeCDEMTRM::ComputeCDEMTRM(LAMMPS *lmp, int narg, char **arg)
    : Compute(lmp, narg, arg), fix_id(std::string("CDEM_TRM_") + arg[0]) {
  if (narg != 3)
    error->all(FLERR, "Compute cdem/trm {}: unknown argument {}; it takes none", id, arg[3]);
  if (!Shearbox::is_sphere(atom))
    error->all(FLERR, "Compute cdem/trm {} needs atom_style sphere", id);
  scalar_flag = 1;
  extscalar = 0;
  peratom_flag = 1;
  size_peratom_cols = 0;
  modify->add_fix(fix_id + " " + group->names[igroup] + " cdem/trm");
}

ComputeCDEMTRM::~ComputeCDEMTRM() {
  if (Shearbox::fix_by_id(lmp, fix_id))
    modify->delete_fix(fix_id); // at the end LAMMPS deletes fixes before computes
}

void ComputeCDEMTRM::init() {
  sums = dynamic_cast<FixCDEMTRM *>(Shearbox::fix_by_id(lmp, fix_id));
  if (!sums)
    error->all(FLERR, "Compute cdem/trm {}: its fix {} is gone; make the compute again", id, fix_id);
  grains = FixCDEMGrains::find(lmp);
  if (!grains || !grains->are_moved())
    error->all(FLERR, "Compute cdem/trm {} needs a fix cdem/integrate", id);
}

bool ComputeCDEMTRM::counts(int i) const {
  return (atom->mask[i] & groupbit) && grains->is_free(i) && sums->travel()[i].path > 0;
}

double ComputeCDEMTRM::ratio(int i) const {
  const auto [path, turned] = sums->travel()[i];
  return atom->radius[i] * turned / path;
}

void ComputeCDEMTRM::compute_peratom() {
  invoked_peratom = update->ntimestep;
  ratios.resize(atom->nmax);
  for (int i = 0; i < atom->nlocal; i++)
    ratios[i] = counts(i) ? ratio(i) : 0;
  vector_atom = ratios.data();
}

double ComputeCDEMTRM::compute_scalar() {
  invoked_scalar = update->ntimestep;
  cdem::ExactSum sum;
  bigint moved = 0, all_moved;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!counts(i))
      continue;
    sum.add(ratio(i));
    moved++;
  }
  MPI_Allreduce(&moved, &all_moved, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  const double total = Shearbox::over_ranks(sum, world);
  scalar = all_moved > 0 ? total / static_cast<double>(all_moved) : 0;
  return scalar;
}

double ComputeCDEMTRM::memory_usage() { return static_cast<double>(ratios.capacity() * sizeof(double)); }
