// SPDX-License-Identifier: GPL-2.0-or-later
#include "motion/verlet_cdem.h"

#include "contacts/pair_cdem.h"
#include "motion/fix_cdem_integrate.h"
#include "motion/fix_cdem_lid.h"
#include "output/fix_cdem_trm.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "timer.h"
#include "update.h"
#include "utils.h"

#include <algorithm>

using namespace LAMMPS_NS;

VerletCDEM::VerletCDEM(LAMMPS *lmp, int narg, char **arg) : Verlet(lmp, narg, arg) {
  if (narg > 0)
    error->all(FLERR, "Run style verlet/cdem: unknown argument {}; it takes none", arg[0]);
}

void VerletCDEM::init() {
  Verlet::init();
  pair = dynamic_cast<PairCDEM *>(force->pair);
  integrate = FixCDEMIntegrate::find(lmp);
  if (!pair)
    error->all(FLERR, "Run style verlet/cdem needs pair_style cdem");
  statistics.clear();
  wall_bodies.clear();
  for (int i = 0; i < modify->nfix; i++) {
    if (auto *fix = dynamic_cast<FixCDEMTRM *>(modify->fix[i]))
      statistics.push_back(fix);
    if (auto *fix = dynamic_cast<WallBody *>(modify->fix[i]))
      wall_bodies.push_back(fix);
  }

  const std::string why = hindrance();
  can_glide = why.empty();
  if (!can_glide && comm->me == 0)
    error->warning(FLERR, "Run style verlet/cdem is no faster than verlet here: " + why);
}

std::string VerletCDEM::hindrance() const {
  if (!integrate)
    return "there is no fix cdem/integrate";
  if (force->bond || force->angle || force->dihedral || force->improper || force->kspace)
    return "there are forces beside those of pair style cdem";
  for (int i = 0; i < modify->nfix; i++)
    if (acts_in_every_step(i))
      return std::string("fix ") + modify->fix[i]->id + " of style " + modify->fix[i]->style +
             " acts in every step (for gravity and drag, fix cdem/integrate has keywords)";
  return "";
}

bool VerletCDEM::acts_in_every_step(int ifix) const {
  const Fix *const fix = modify->fix[ifix];
  if (const auto *lid = dynamic_cast<const FixCDEMLid *>(fix))
    return lid->has_variable();
  if (utils::strmatch(fix->style, "^cdem/")) // NOLINT(clang-analyzer-core.NullDereference): no fix here is null
    return false;
  constexpr int WITHIN = FixConst::INITIAL_INTEGRATE | FixConst::POST_INTEGRATE | FixConst::PRE_FORCE |
                         FixConst::PRE_REVERSE | FixConst::POST_FORCE | FixConst::FINAL_INTEGRATE;
  const int mask = modify->fmask[ifix];
  return (mask & WITHIN) || ((mask & FixConst::END_OF_STEP) && fix->nevery == 1);
}

// The next step at whose end something looks at the atoms.
bigint VerletCDEM::next_look() const {
  const bigint now = update->ntimestep;
  bigint next = std::min(update->laststep, output->next);
  for (int i = 0; i < modify->nfix; i++)
    if (const int every = modify->fix[i]->nevery; (modify->fmask[i] & FixConst::END_OF_STEP) && every > 0)
      next = std::min(next, (now / every + 1) * every);
  return next;
}

// The next step in which a fix or neigh_modify has the list rebuilt.
bigint VerletCDEM::next_rebuild() const {
  const bigint now = update->ntimestep;
  bigint next = MAXBIGINT;
  for (int i = 0; i < modify->nfix; i++)
    if (const Fix *const fix = modify->fix[i]; fix->force_reneighbor && fix->next_reneighbor > now)
      next = std::min(next, fix->next_reneighbor);
  if (!neighbor->dist_check) {
    const int least = std::max(neighbor->ago + 1, neighbor->delay);
    next = std::min(next, now + (least + neighbor->every - 1) / neighbor->every * neighbor->every - neighbor->ago);
  }
  return next;
}

void VerletCDEM::run(int n) {
  run_start = update->ntimestep;
  const bigint last = run_start + n;
  while (update->ntimestep < last && !stopped()) {
    const bigint look = std::min(last, next_look());
    if (can_glide && glide_to(look))
      finish_step();
    else if (!stopped())
      Verlet::run(1);
  }
}

// Whether this step has been made, all but its end; else the next one is Verlet's, which also tallies energy and
// virial.
bool VerletCDEM::glide_to(bigint look) {
  ev_set(look);
  const bool tally = eflag || vflag;
  const bigint target = std::min(tally ? look - 1 : look, next_rebuild() - 1);
  glide(target);
  return update->ntimestep == look;
}

// As in Verlet::run.
void VerletCDEM::finish_step() {
  if (modify->n_end_of_step)
    modify->end_of_step();
  timer->stamp(Timer::MODIFY);
  if (update->ntimestep == output->next) {
    output->write(update->ntimestep);
    timer->stamp(Timer::OUTPUT);
  }
}

// By timer timeout, or by fix halt.
bool VerletCDEM::stopped() {
  const int done = int(update->ntimestep - run_start);
  if (!timer->check_timeout(done))
    return false;
  update->nsteps = done;
  return true;
}

// Steps until `target`, or until the neighbour list has to be rebuilt.
void VerletCDEM::glide(bigint target) {
  timer->stamp();
  reach = pair->largest_reach();
  measure_room();
  travelled = 0;
  if (!rebuild_is_due(0, pair->rows.fastest(atom->nlocal)) && update->ntimestep < target)
    glide_on(target);
  timer->stamp(Timer::PAIR);
}

void VerletCDEM::glide_on(bigint target) {
  find_walls();
  begin_step();
  cdem::Fastest fastest = pair->rows.fastest(atom->nlocal);
  for (;;) {
    pair->exchange_ghosts();
    const bool due = rebuild_is_due(1, fastest);
    pair->refresh_list(stride);
    if (due || update->ntimestep == target || stopped())
      break;
    fastest = {};
    step(fastest);
  }
  for (WallBody *fix : wall_bodies)
    fix->move_rows(nullptr);
  pair->rows.write_back();
  comm->forward_comm(); // for those who look at ghosts
  force_clear();
  pair->forces();
  integrate->post_force(0);
  modify->final_integrate();
}

// The first of the statistics is taken where the grains are moved, others by loops of their own.
void VerletCDEM::step(cdem::Fastest &fastest) {
  integrate->book_drag(pair->rows);
  const auto first = statistics.begin(), end = statistics.end();
  pair->forces_and_advance(rule, felt, fastest, first != end ? (*first)->travel() : nullptr);
  move_walls(fastest);
  if (first != end)
    std::for_each(first + 1, end, [this](FixCDEMTRM *fix) { fix->add(pair->rows); });
}

// As Verlet does it, on the atoms' arrays.
void VerletCDEM::begin_step() {
  update->ntimestep++;
  neighbor->ago++;
  modify->initial_integrate(0);
  if (modify->n_post_integrate)
    modify->post_integrate();

  rule = integrate->step_rule();
  pair->rows.take_bodies();
  pair->rows.fill(0, atom->nlocal, rule.forward);
  for (WallBody *fix : wall_bodies)
    fix->move_rows(&pair->rows);
}

void VerletCDEM::find_walls() {
  felt.clear();
  for (const WallBody *fix : wall_bodies)
    if (fix->follows_forces())
      felt.insert(felt.end(), fix->own_discs().begin(), fix->own_discs().end());
  std::sort(felt.begin(), felt.end());
}

// The second half of a step and the first of the next, by the fixes that move them.
void VerletCDEM::move_walls(cdem::Fastest &fastest) {
  for (WallBody *fix : wall_bodies)
    fix->final_integrate();
  update->ntimestep++;
  neighbor->ago++;
  for (WallBody *fix : wall_bodies)
    fix->initial_integrate(0);
  for (const WallBody *fix : wall_bodies)
    fastest.see(cdem::Four{fix->speed() * fix->speed(), 0, 0, 0});
}

void VerletCDEM::measure_room() {
  const double mine = pair->room();
  MPI_Allreduce(&mine, &room, 1, MPI_DOUBLE, MPI_MIN, world);
}

// The list is good for the next step as long as the room left in it is more than SAFETY times what the fastest moved in
// the last one; and it is not worth keeping for LEAST of half the skin. What all have travelled is at most what the
// fastest has in every step, so only when that bound is used up is the room measured; and from time to time, since it
// is none if a position is no number. That changes nothing: the list is rebuilt in the same step for any number of
// ranks, and whatever is written in between.
bool VerletCDEM::rebuild_is_due(int steps, const cdem::Fastest &fastest) {
  constexpr double SAFETY = 4, LEAST = 0.05;
  const double mine[] = {fastest.vx2, fastest.vy2, fastest.omega2, reach};
  double all[4]; // of all ranks, each by itself: the speed of a rank's own largest components depends on who is there
  MPI_Allreduce(mine, all, 4, MPI_DOUBLE, MPI_MAX, world);
  stride = update->dt * cdem::Fastest{all[0], all[1], all[2]}.speed(all[3]);
  if (integrate->guard.suspects(stride)) {
    if (steps > 0)
      pair->rows.write_back();
    integrate->guard.check();
  }
  travelled += steps * stride;
  const double needed = std::max(SAFETY * stride, LEAST * 0.5 * neighbor->skin);
  const bool just_measured = steps == 0;
  if (travelled + needed < room && (just_measured || !integrate->guard.is_due()))
    return false;
  measure_room();
  travelled = 0;
  if (needed < room)
    return false;
  if (room < 0)
    neighbor->ndanger++;
  integrate->rebuild_next();
  return true;
}
