// SPDX-License-Identifier: GPL-2.0-or-later
#include "liggghts/fix_lid.h"

#include "liggghts/accumulation.h"

#include "atom.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;

namespace Liggghts {

FixLid::FixLid(LAMMPS *lmp, int narg, char **arg) : WallBody(lmp, narg, arg) {
  Words words = words_of(narg, arg);
  words.keyword("stress");
  stress = words.not_negative("stress");
  words.keyword("width");
  width = words.positive("width");
  words.keyword("thickness");
  thickness = words.positive("thickness");
  if (!words.done()) {
    words.keyword("vmax");
    given_cap = words.positive("vmax");
  }
  size_vector = NOUTPUTS;
}

void FixLid::init() {
  WallBody::init();
  mass = total_mass();
  fastest = given_cap > 0 ? given_cap : stress * width * thickness / std::sqrt(count() * largest_stiffness() * mass);
}

double FixLid::largest_stiffness() const {
  const Accumulation &law = Accumulation::needed_by("Fix cdem/lid: vmax", lmp);
  double kn = 0;
  for (int i = 1; i <= law.types(); i++)
    for (int j = 1; j <= law.types(); j++)
      kn = std::max(kn, law.material(i, j).kn);
  return kn;
}

void FixLid::take_acceleration() {
  felt_force = force().y;
  motion.acceleration = (felt_force - stress * width * thickness) / mass;
}

void FixLid::setup(int) {
  take_acceleration();
  set_motion({0, motion.velocity}, {0, motion.acceleration});
}

void FixLid::initial_integrate(int) {
  motion.begin_step(update->dt, fastest);
  shift({0, update->dt * motion.velocity}, {0, motion.velocity});
}

void FixLid::final_integrate() {
  take_acceleration();
  motion.end_step(update->dt, fastest);
  set_motion({0, motion.velocity}, {0, motion.acceleration});
}

double FixLid::lower_face() const {
  double lowest = INFINITY;
  for (int i = 0; i < atom->nlocal; i++)
    if (in_group(i))
      lowest = std::min(lowest, atom->x[i][1] - atom->radius[i]);
  return smallest_of_ranks(lmp, lowest);
}

double FixLid::compute_vector(int n) {
  switch (n) {
  case APPLIED:
    return stress;
  case FELT:
    return felt_force / (width * thickness);
  case HEIGHT:
    return lower_face();
  case VELOCITY:
    return motion.velocity;
  case CAPPED_STEPS:
    return motion.capped_steps;
  default:
    return force().x;
  }
}

} // namespace Liggghts
