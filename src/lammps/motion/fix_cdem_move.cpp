// SPDX-License-Identifier: GPL-2.0-or-later
#include "motion/fix_cdem_move.h"

#include "host/compat.h"
#include "host/packed_state.h"

#include "comm.h"
#include "error.h"
#include "update.h"

#include <cmath>
#include <string>

using namespace LAMMPS_NS;

FixCDEMMove::FixCDEMMove(LAMMPS *lmp, int narg, char **arg) : WallBody(lmp, narg, arg) {
  bool has_speed = false, has_stop = false;
  Shearbox::DeckWords words = words_of(narg, arg);
  while (!words.done()) {
    const std::string keyword = words.word("keyword");
    if (keyword == "speed") {
      has_speed = true;
      path.speed = words.number("speed");
    } else if (keyword == "dir") {
      const std::string dir = words.choice();
      if (dir != "x" && dir != "y")
        error->all(FLERR, "Fix cdem/move {}: dir {}: must be x or y", id, dir);
      vertical = dir == "y";
    } else if (keyword == "ramp")
      path.ramp = words.number("ramp");
    else if (keyword == "stop") {
      has_stop = true;
      path.stop = words.number("stop");
    } else
      error->all(FLERR, "Fix cdem/move {}: unknown keyword {}; allowed: speed, dir, ramp, stop", id, keyword);
  }
  if (!has_speed)
    error->all(FLERR, "Fix cdem/move {}: speed (m/s) is missing", id);
  if (!std::isfinite(path.speed))
    error->all(FLERR, "Fix cdem/move {}: speed {}: must be a number (m/s)", id, path.speed);
  if (!(path.ramp >= 0 && std::isfinite(path.ramp)))
    error->all(FLERR, "Fix cdem/move {}: ramp {}: must be 0 or more (s)", id, path.ramp);
  if (has_stop && !(path.stop > 0 && std::isfinite(path.stop)))
    error->all(FLERR, "Fix cdem/move {}: stop {}: must be positive (m)", id, path.stop);
  size_vector = NOUTPUTS;
}

// LAMMPS has given this fix its state by now.
void FixCDEMMove::post_constructor() {
  if (path.speed != 0)
    left = Shearbox::states_left(lmp, style);
}

// Fixes that were defined later may have taken theirs.
void FixCDEMMove::refuse_other_id() const {
  for (const std::string &other : left)
    if (!Shearbox::fix_by_id(lmp, other))
      error->all(
          FLERR,
          "Fix cdem/move {}: the restart file has the motion of a fix cdem/move {}, which is not there: name this "
          "one {} to go on with it; to move anew, define fix {} with speed 0 and unfix it before",
          id, other, other, other);
}

void FixCDEMMove::init() {
  refuse_other_id();
  WallBody::init();
  reset_dt();
  now = motion();
  apply();
}

void FixCDEMMove::reset_dt() { clock.take_step_of(update->dt); }

FixCDEMMove::Motion FixCDEMMove::motion() const { return path.at(clock.time()); }

WallBody::Vector FixCDEMMove::along(double amount) const { return vertical ? Vector{0, amount} : Vector{amount, 0}; }

void FixCDEMMove::apply() { set_motion(along(now.speed), along(now.acceleration)); }

void FixCDEMMove::initial_integrate(int) {
  if (path.speed == 0)
    return;
  reset_dt(); // timestep may have changed it before a run without a setup
  clock.steps++;
  const double before = now.s;
  now = motion();
  shift(along(now.s - before), along((now.s - before) / update->dt));
}

void FixCDEMMove::final_integrate() {
  if (path.speed == 0)
    return;
  apply();
  if (follows_forces())
    book_work(force());
}

void FixCDEMMove::setup(int) {
  apply();
  if (follows_forces())
    book_start(force());
}

WallBody::Vector FixCDEMMove::force() const { return along(vertical ? total_force(Y) : total_force(X)); }

double FixCDEMMove::compute_vector(int n) {
  switch (n) {
  case DISPLACEMENT:
    return now.s;
  case SPEED:
    return now.speed;
  case FORCE_X:
    return total_force(X);
  default:
    return total_force(Y);
  }
}

void FixCDEMMove::write_restart(FILE *fp) {
  if (comm->me == 0)
    Shearbox::write_state(fp, Saved{{clock, now.s, vertical}, booked});
}

void FixCDEMMove::restart(char *buf) {
  const auto saved = Shearbox::read_state<Saved>(lmp, style, buf);
  booked = saved.booked;
  if (path.speed == 0)
    return;
  clock = saved.motion.clock;
  now = motion();
  if (!saved.motion.is_on(path, vertical))
    error->all(FLERR,
               "Fix cdem/move {}: in the restart file the wall has moved by {:.9g} m along {} in {:.9g} s; by this "
               "speed, ramp, stop and dir it would be {:.9g} m along {}: give those it had; to move anew, define fix "
               "{} with speed 0 and unfix it before",
               id, saved.motion.s, saved.motion.along_y ? "y" : "x", clock.time(), now.s, vertical ? "y" : "x", id);
}
