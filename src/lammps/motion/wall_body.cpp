// SPDX-License-Identifier: GPL-2.0-or-later
#include "motion/wall_body.h"

#include "grains/fix_cdem_audit.h"
#include "grains/fix_cdem_grains.h"
#include "host/compat.h"
#include "host/rank_sum.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fmt/format.h"
#include "group.h"
#include "modify.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

WallBody::WallBody(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  if (domain->dimension != 2)
    error->all(FLERR, "Fix {} {}: dimension is {}, must be 2", style, id, domain->dimension);
  if (!Shearbox::is_sphere(atom))
    error->all(FLERR, "Fix {} {} needs atom_style sphere", style, id);
  time_integrate = 1;
  vector_flag = 1;
  global_freq = 1;
  extvector = 0;
  restart_global = 1;
}

int WallBody::setmask() { return FixConst::INITIAL_INTEGRATE | FixConst::PRE_NEIGHBOR | FixConst::FINAL_INTEGRATE; }

Shearbox::DeckWords WallBody::words_of(int narg, char **arg) const {
  return Shearbox::DeckWords(lmp, fmt::format("Fix {} {}", style, id), narg, arg, 3);
}

void WallBody::init() {
  const char *const name = group->names[igroup];
  if (group->count(igroup) == 0)
    error->all(FLERR, "Fix {} {}: group {} has no atoms", style, id, name);

  audit = FixCDEMAudit::find(lmp);
  grains = FixCDEMGrains::find(lmp);
  if (grains && grains->are_moved())
    if (const bigint n = count_also_in(group->bitmask[grains->group_of_grains()]))
      error->all(FLERR, "Fix {} {}: {} atoms of group {} are also in group {}, which fix cdem/integrate moves", style,
                 id, n, name, group->names[grains->group_of_grains()]);
  refuse_other_movers();
  pre_neighbor();
  for (int i : discs)
    std::fill_n(atom->omega[i], 3, 0.0);
}

namespace {
bool sets_forces(const std::string &style) {
  return utils::strmatch(style, "^setforce") || utils::strmatch(style, "^freeze");
}
} // namespace

void WallBody::refuse_other_movers() const {
  for (int k = 0; k < modify->nfix; k++) {
    const Fix *const other = modify->fix[k];
    const bool moves = other->time_integrate;
    if (other == this || !(moves || sets_forces(other->style)))
      continue;
    const bigint n = count_also_in(other->groupbit);
    if (n > 0 && moves)
      error->all(FLERR, "Fix {} {}: {} atoms of group {} are also moved by fix {} {}", style, id, n,
                 group->names[igroup], other->style, other->id);
    if (n > 0 && update->whichflag != 0 && comm->me == 0) // else no run begins
      error->warning(
          FLERR, "Fix {} {}: fix {} of style {} sets forces on {} of its atoms: what grains do to them may not be felt",
          style, id, other->id, other->style, n);
  }
}

bigint WallBody::count_also_in(int other_groupbit) const {
  bigint mine = 0, all;
  for (int i = 0; i < atom->nlocal; i++)
    if (in_group(i) && (atom->mask[i] & other_groupbit))
      mine++;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return all;
}

bool WallBody::in_group(int i) const { return atom->mask[i] & groupbit; }

double WallBody::angle(int i) const { return grains ? grains->angle(i) : 0; }

void WallBody::setup_pre_neighbor() { pre_neighbor(); }

void WallBody::pre_neighbor() {
  discs.clear();
  for (int i = 0; i < atom->nlocal; i++)
    if (in_group(i))
      discs.push_back(i);
}

template <class Term> double WallBody::sum(Term term, double unit) const {
  cdem::ExactSum mine;
  for (int i : discs)
    mine.add(term(i) / unit);
  return Shearbox::over_ranks(mine, world) * unit;
}

// Of terms that may all be small, such as the masses of tiny discs.
template <class Term> double WallBody::sum_of_small(Term term) const {
  double mine = 0, most;
  for (int i : discs)
    mine = std::max(mine, std::fabs(term(i)));
  MPI_Allreduce(&mine, &most, 1, MPI_DOUBLE, MPI_MAX, world);
  return sum(term, cdem::unit_for(most));
}

double WallBody::total_force(Axis axis) const {
  return sum([=](int i) { return atom->f[i][axis]; }, force_unit);
}

double WallBody::momentum(Axis axis) const {
  return sum_of_small([=](int i) { return atom->rmass[i] * atom->v[i][axis]; });
}

double WallBody::total_mass() const {
  return sum_of_small([this](int i) { return atom->rmass[i]; });
}

void WallBody::move_rows(GrainRows *where) { rows = where; }

double WallBody::speed() const { return std::hypot(velocity_of_step.x, velocity_of_step.y); }

void WallBody::set_motion(Vector velocity, Vector acceleration) {
  acceleration_now = acceleration;
  if (rows)
    return;
  for (int i : discs) {
    atom->v[i][0] = velocity.x;
    atom->v[i][1] = velocity.y;
    if (grains)
      grains->set_acceleration(i, {acceleration.x, acceleration.y, 0});
  }
}

void WallBody::book_work(Vector force) {
  if (audit && comm->me == 0)
    audit->books.walls -= 0.5 * ((booked.force.x + force.x) * displacement_of_step.x +
                                 (booked.force.y + force.y) * displacement_of_step.y);
  booked = {force, double(update->ntimestep)};
}

void WallBody::book_start(Vector force) {
  if (booked.step != update->ntimestep)
    booked = {force, double(update->ntimestep)};
}

void WallBody::shift(Vector displacement, Vector velocity) {
  displacement_of_step = displacement;
  velocity_of_step = velocity;
  if (rows) {
    const double forward = grains->step_rule().forward;
    const Vector ahead{velocity.x + forward * acceleration_now.x, velocity.y + forward * acceleration_now.y};
    rows->shift(discs, displacement, velocity, ahead);
    return;
  }
  for (int i : discs) {
    atom->x[i][0] += displacement.x;
    atom->x[i][1] += displacement.y;
    atom->v[i][0] = velocity.x;
    atom->v[i][1] = velocity.y;
  }
}
