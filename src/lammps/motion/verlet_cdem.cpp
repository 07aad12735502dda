// SPDX-License-Identifier: GPL-2.0-or-later
#include "motion/verlet_cdem.h"

#include "contacts/pair_cdem.h"
#include "motion/fix_cdem_integrate.h"
#include "motion/wall_body.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "timer.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

VerletCDEM::VerletCDEM(LAMMPS *lmp, int narg, char **arg) : Verlet(lmp, narg, arg) {
  if (narg > 0)
    error->all(FLERR, "Run style verlet/cdem: unknown argument {}; it takes none", arg[0]);
}

void VerletCDEM::init() {
  Verlet::init();
  integrate = FixCDEMIntegrate::find(lmp);
  grains = FixCDEMGrains::find(lmp);
  contacts = &PairCDEM::needed_by("Run style verlet/cdem", lmp)->contacts;
  statistics.clear();
  wall_bodies.clear();
  for (int i = 0; i < modify->nfix; i++) {
    Fix &fix = *modify->fix[i];
    if (auto *sums = dynamic_cast<SumsSteps *>(&fix))
      statistics.push_back(sums);
    if (auto *wall = dynamic_cast<WallBody *>(&fix))
      wall_bodies.push_back(wall);
  }

  const std::string why = hindrance();
  if (!why.empty() && comm->me == 0)
    error->warning(FLERR, "Run style verlet/cdem is no faster than verlet here: " + why);
}

namespace {
std::string keyword_for(const std::string &style) {
  if (style != "gravity" && style != "viscous")
    return "";
  return fmt::format("; fix cdem/integrate has a keyword for it, {}", style == "gravity" ? "gravity" : "drag");
}
} // namespace

std::string VerletCDEM::hindrance() const {
  if (!integrate)
    return "there is no fix cdem/integrate";
  if (force->bond || force->angle || force->dihedral || force->improper || force->kspace)
    return "there are other forces than those of pair style cdem";
  constexpr int DEFORMS = Fix::BOX_CHANGE_SIZE | Fix::BOX_CHANGE_SHAPE;
  for (int i = 0; i < modify->nfix; i++) {
    const Fix &fix = *modify->fix[i];
    const std::string name = std::string("fix ") + fix.id + " of style " + fix.style;
    // NOLINTNEXTLINE(clang-analyzer-core.NullDereference): none is null, as it takes from the casts in init()
    if (acts_in_every_step(fix, modify->fmask[i]))
      return name + " acts in every step" + keyword_for(fix.style);
    if (fix.box_change & DEFORMS)
      return name + " changes the box, which moves images of grains";
  }
  return "";
}

bool VerletCDEM::acts_in_every_step(const Fix &fix, int mask) {
  if (const auto *glides = dynamic_cast<const Glides *>(&fix))
    return glides->needs_every_step();
  constexpr int WITHIN = FixConst::INITIAL_INTEGRATE | FixConst::POST_INTEGRATE | FixConst::PRE_FORCE |
                         FixConst::PRE_REVERSE | FixConst::POST_FORCE | FixConst::FINAL_INTEGRATE;
  return (mask & WITHIN) || ((mask & FixConst::END_OF_STEP) && fix.nevery == 1);
}

// The next step at whose end a fix or output reads the atoms.
bigint VerletCDEM::next_look() const {
  const bigint now = update->ntimestep;
  bigint next = std::min(update->laststep, output->next);
  for (int i = 0; i < modify->nfix; i++)
    if (const int every = modify->fix[i]->nevery; (modify->fmask[i] & FixConst::END_OF_STEP) && every > 0)
      next = std::min(next, (now / every + 1) * every);
  return next;
}

// The next step in which the neighbour list is to be rebuilt for a fix, for neigh_modify, or for a restart file: in it
// the atoms must be inside the box and on the rank that owns their place.
bigint VerletCDEM::next_rebuild() const {
  const bigint now = update->ntimestep;
  bigint next = output->restart_flag && output->next_restart > now ? output->next_restart : MAXBIGINT;
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
  const bool can_glide = hindrance().empty(); // fix_modify may have changed it before a run without a setup
  if (can_glide) {                            // before such a run commands may have moved atoms
    integrate->check_preparation();
    contacts->take_places();
  }
  while (update->ntimestep < last && !stopped()) {
    const bigint look = std::min(last, next_look());
    if (can_glide && glide_to(look))
      finish_step();
    else if (!stopped())
      Verlet::run(1);
  }
}

// Makes steps up to `look`, the next step at whose end something reads the atoms. True if that step was made too, all
// except its end (finish_step()); otherwise the next step is one of Verlet, which also tallies energy and virial.
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

// Whether the run was stopped, by timer timeout or by fix halt.
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
  reach = contacts->largest_reach();
  measure_room();
  travelled = 0;
  if (!rebuild_is_due(0, contacts->rows.fastest(atom->nlocal)) && update->ntimestep < target)
    glide_on(target);
  timer->stamp(Timer::PAIR);
}

void VerletCDEM::glide_on(bigint target) {
  find_walls();
  begin_step();
  cdem::Fastest fastest = contacts->rows.fastest(atom->nlocal);
  for (;;) {
    contacts->rows.exchange_ghosts();
    const bool due = rebuild_is_due(1, fastest);
    contacts->refresh(stride);
    if (due || update->ntimestep == target || stopped())
      break;
    fastest = {};
    step(fastest);
  }
  for (WallBody *fix : wall_bodies)
    fix->move_rows(nullptr);
  contacts->rows.write_back();
  comm->forward_comm(); // ghosts may be read, too
  force_clear();
  contacts->forces();
  integrate->pre_reverse(eflag, vflag);
  modify->final_integrate();
}

// The loop that moves the grains also serves the first fix that sums up steps; others have loops of their own.
void VerletCDEM::step(cdem::Fastest &fastest) {
  integrate->body_forces.book_drag(contacts->rows);
  const auto first = statistics.begin(), end = statistics.end();
  contacts->forces_and_advance(rule, felt, fastest, first != end ? (*first)->travel() : nullptr);
  move_walls(fastest);
  if (first != end)
    std::for_each(first + 1, end, [this](SumsSteps *fix) { fix->add(contacts->rows); });
}

// The first half of a step as Verlet makes it, on the atoms' arrays; then fills the rows.
void VerletCDEM::begin_step() {
  update->ntimestep++;
  neighbor->ago++;
  modify->initial_integrate(0);
  if (modify->n_post_integrate)
    modify->post_integrate();

  rule = grains->step_rule();
  contacts->rows.take_bodies();
  contacts->rows.fill(0, atom->nlocal, rule.forward);
  for (WallBody *fix : wall_bodies)
    fix->move_rows(&contacts->rows);
}

void VerletCDEM::find_walls() {
  felt.clear();
  for (const WallBody *fix : wall_bodies)
    if (fix->follows_forces())
      felt.insert(felt.end(), fix->own_discs().begin(), fix->own_discs().end());
  std::sort(felt.begin(), felt.end());
}

// Makes the second half of a step and the first half of the next for the walls, by the fixes that move them.
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
  const double mine = contacts->room();
  MPI_Allreduce(&mine, &room, 1, MPI_DOUBLE, MPI_MIN, world);
}

// The list is rebuilt when the room left in it is no more than SAFETY times what the fastest grain moved in the last
// step, or LEAST of half the skin. No grain has travelled further than the sum of what the fastest moved in each step:
// only when that bound is used up is the room measured. It is measured every 100 steps too, since a position that is
// not a number moves no bound. When it is measured does not change in which step the list is rebuilt: that is the same
// for any number of ranks and any output.
bool VerletCDEM::rebuild_is_due(int steps, const cdem::Fastest &fastest) {
  constexpr double SAFETY = 4, LEAST = 0.05;
  const double mine[] = {fastest.vx2, fastest.vy2, fastest.omega2, reach};
  // Largest over all ranks, each by itself: a speed from the components of one rank depends on which grains it has.
  double all[4];
  MPI_Allreduce(mine, all, 4, MPI_DOUBLE, MPI_MAX, world);
  stride = update->dt * cdem::Fastest{all[0], all[1], all[2]}.speed(all[3]);
  if (integrate->guard.suspects(stride)) {
    if (steps > 0)
      contacts->rows.write_back();
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
