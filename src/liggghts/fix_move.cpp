// SPDX-License-Identifier: GPL-2.0-or-later
#include "liggghts/fix_move.h"

#include "comm.h"
#include "update.h"

#include <cstdio>
#include <cstring>

using namespace LAMMPS_NS;

namespace Liggghts {

FixMove::FixMove(LAMMPS *lmp, int narg, char **arg) : WallBody(lmp, narg, arg) {
  Words words = words_of(narg, arg);
  words.keyword("speed");
  path.speed = words.number("speed");
  while (!words.done()) {
    const std::string keyword = words.word("keyword");
    if (keyword == "dir") {
      const std::string dir = words.word("dir");
      if (dir != "x" && dir != "y")
        stop(lmp, "Fix cdem/move ", id, ": dir ", dir, ": must be x or y");
      vertical = dir == "y";
    } else if (keyword == "ramp")
      path.ramp = words.not_negative("ramp");
    else if (keyword == "stop")
      path.stop = words.positive("stop");
    else
      stop(lmp, "Fix cdem/move ", id, ": unknown keyword ", keyword, "; allowed: speed, dir, ramp, stop");
  }
  size_vector = NOUTPUTS;
  restart_global = 1;
}

void FixMove::init() {
  WallBody::init();
  reset_dt();
  now = at_present();
}

void FixMove::reset_dt() { clock.take_step_of(update->dt); }

void FixMove::initial_integrate(int) {
  clock.steps++;
  const double before = now.s;
  now = at_present();
  shift(along(now.s - before), along((now.s - before) / update->dt));
}

double FixMove::compute_vector(int n) {
  switch (n) {
  case DISPLACEMENT:
    return now.s;
  case SPEED:
    return now.speed;
  case FORCE_X:
    return force().x;
  default:
    return force().y;
  }
}

void FixMove::write_restart(FILE *file) {
  if (comm->me != 0)
    return;
  const cdem::KeptMotion saved{clock, now.s, vertical};
  const int size = sizeof saved;
  std::fwrite(&size, sizeof size, 1, file);
  std::fwrite(&saved, sizeof saved, 1, file);
}

void FixMove::restart(char *state) {
  cdem::KeptMotion saved;
  std::memcpy(&saved, state, sizeof saved);
  if (path.speed == 0)
    return;
  clock = saved.clock;
  now = at_present();
  if (!saved.is_on(path, vertical))
    stop(lmp, "Fix cdem/move ", id, ": in the restart file the wall has moved by ", saved.s, " m along ",
         saved.along_y ? "y" : "x", " in ", clock.time(), " s; by this speed, ramp, stop and dir it would be ", now.s,
         " m along ", vertical ? "y" : "x", ": give those it had");
}

} // namespace Liggghts
