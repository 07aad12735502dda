// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/compute_cdem_energy.h"

#include "contacts/pair_cdem.h"
#include "grains/fix_cdem_grains.h"
#include "host/compat.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "update.h"

#include <cstring>
#include <string>

using namespace LAMMPS_NS;

ComputeCDEMEnergy::ComputeCDEMEnergy(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg) {
  bool audits = false;
  for (int iarg = 3; iarg < narg; iarg += 2) {
    const std::string value = iarg + 1 < narg ? arg[iarg + 1] : "nothing";
    if (strcmp(arg[iarg], "audit") != 0)
      error->all(FLERR, "Compute cdem/energy {}: unknown argument {}; allowed: audit yes|no", id, arg[iarg]);
    if (value != "yes" && value != "no")
      error->all(FLERR, "Compute cdem/energy {}: audit {}: must be yes or no", id, value);
    audits = value == "yes";
  }
  if (!Shearbox::is_sphere(atom))
    error->all(FLERR, "Compute cdem/energy {} needs atom_style sphere", id);
  if (audits) {
    if (FixCDEMAudit::find(lmp))
      error->all(FLERR, "Compute cdem/energy {}: there is one with an audit already", id);
    audit = static_cast<FixCDEMAudit *>(modify->add_fix(std::string(FixCDEMAudit::ID) + " all cdem/audit"));
    audit->opener = this;
  }
  scalar_flag = vector_flag = 1;
  extscalar = extvector = 1;
  size_vector = audits ? int(NALL) : int(NPARTS);
  vector = energy.data();
}

ComputeCDEMEnergy::~ComputeCDEMEnergy() {
  if (audit && Shearbox::fix_by_id(lmp, FixCDEMAudit::ID))
    modify->delete_fix(FixCDEMAudit::ID); // at the end LAMMPS deletes fixes before computes
}

void ComputeCDEMEnergy::refuse_lost_audit() const {
  if (audit && !Shearbox::fix_by_id(lmp, FixCDEMAudit::ID))
    error->all(FLERR,
               "Compute cdem/energy {}: fix {}, which has the books of the audit, was removed; uncompute {} first", id,
               FixCDEMAudit::ID, id);
}

void ComputeCDEMEnergy::init() {
  refuse_lost_audit();
  pair = PairCDEM::needed_by(fmt::format("Compute cdem/energy {}", id), lmp);
  grains = FixCDEMGrains::find(lmp);
}

void ComputeCDEMEnergy::compute_vector() {
  invoked_vector = update->ntimestep;
  if (!pair) // made after the last run, and the next is one with "pre no"
    init();
  refuse_lost_audit();
  std::array<double, NPARTS> mine{};
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit))
      continue;
    const auto [translation, rotation] = kinetic(i);
    mine[TRANSLATION] += translation;
    mine[ROTATION] += rotation;
  }
  const auto [normal, tangential, added] = pair->report.energy();
  mine[SPRINGS] = normal + tangential + added;
  MPI_Allreduce(mine.data(), energy.data(), NPARTS, MPI_DOUBLE, MPI_SUM, world);
  if (audit)
    keep_books();
}

// A piece of a smooth wall, whose inertia is infinite, does not turn.
ComputeCDEMEnergy::Kinetic ComputeCDEMEnergy::kinetic(int i) const {
  const double m = atom->rmass[i], r = atom->radius[i], omega = atom->omega[i][2];
  const double *const v = atom->v[i];
  const double translation = 0.5 * m * (v[0] * v[0] + v[1] * v[1]);
  if (pair->contacts.rows.shape_of_type(atom->type[i]).is_line())
    return {translation, 0};
  return {translation, 0.5 * (grains->inertia(atom->type[i]) * m * r * r) * omega * omega};
}

ComputeCDEMEnergy::State ComputeCDEMEnergy::state() const {
  const auto [normal, tangential, added] = pair->report.energy();
  double mine[3] = {0, normal + tangential + added, tangential}, all[3];
  for (int i = 0; i < atom->nlocal; i++) {
    if (!grains->is_free(i))
      continue;
    const auto [translation, rotation] = kinetic(i);
    mine[0] += translation + rotation;
  }
  MPI_Allreduce(mine, all, 3, MPI_DOUBLE, MPI_SUM, world);
  return {all[0], all[1], all[2]};
}

double ComputeCDEMEnergy::work_of_gravity(double gx, double gy) const {
  double mine = 0, all;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!grains->is_free(i))
      continue;
    double x[3];
    domain->unmap(atom->x[i], atom->image[i], x);
    mine += atom->rmass[i] * (gx * x[0] + gy * x[1]);
  }
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

void ComputeCDEMEnergy::open_books() {
  if (audit->open)
    return;
  if (!pair->contacts.pairs.has_books())
    error->all(FLERR, "Compute cdem/energy {}: the first run with an audit must not be 'pre no'", id);
  const State now = state();
  pair->contacts.history.book_losses();
  audit->books = {};
  const cdem::StepRule step = grains->step_rule();
  audit->opening = {now.kinetic + now.springs, step.gx, step.gy, work_of_gravity(step.gx, step.gy)};
  audit->open = true;
}

void ComputeCDEMEnergy::take_gravity() {
  grains = FixCDEMGrains::find(lmp);
  const cdem::StepRule step = grains->step_rule();
  FixCDEMAudit::Opening &from = audit->opening;
  if (step.gx == from.gx && step.gy == from.gy)
    return;
  from.gravity += work_of_gravity(step.gx - from.gx, step.gy - from.gy);
  from.gx = step.gx, from.gy = step.gy;
}

void ComputeCDEMEnergy::book_losses() { pair->contacts.history.book_losses(); }

void ComputeCDEMEnergy::keep_books() {
  open_books();
  book_losses();
  const State now = state();
  const auto [friction, dashpots, drag, walls] = audit->all();
  energy[TANGENTIAL] = now.tangential;
  energy[FRICTION] = friction;
  energy[DASHPOTS] = dashpots;
  energy[DRAG] = drag;
  energy[WALLS] = walls;
  energy[GRAVITY] = work_of_gravity(audit->opening.gx, audit->opening.gy) - audit->opening.gravity;
  energy[RESIDUAL] =
      now.kinetic + now.springs - audit->opening.energy + friction + dashpots + drag - energy[WALLS] - energy[GRAVITY];
}

double ComputeCDEMEnergy::compute_scalar() {
  compute_vector();
  invoked_scalar = update->ntimestep;
  scalar = energy[TRANSLATION] + energy[ROTATION] + energy[SPRINGS];
  return scalar;
}
