// SPDX-License-Identifier: GPL-2.0-or-later
#include "motion/fix_cdem_lid.h"

#include "contacts/pair_cdem.h"
#include "core/exact_sum.h"
#include "core/rotation.h"
#include "grains/fix_cdem_shape.h"
#include "host/packed_state.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "input.h"
#include "modify.h"
#include "update.h"
#include "utils.h"
#include "variable.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

FixCDEMLid::FixCDEMLid(LAMMPS *lmp, int narg, char **arg) : WallBody(lmp, narg, arg) {
  bool has_stress = false;
  Shearbox::DeckWords words = words_of(narg, arg);
  while (!words.done()) {
    const std::string keyword = words.word("keyword");
    if (keyword == "stress") {
      has_stress = true;
      read_stress(words);
    } else if (keyword == "width")
      width = words.number("width");
    else if (keyword == "thickness")
      thickness = words.number("thickness");
    else if (keyword == "from")
      read_side(words);
    else if (keyword == "vmax") {
      if (words.take("auto"))
        given_cap = 0;
      else if (!((given_cap = words.number("vmax")) > 0 && std::isfinite(given_cap)))
        error->all(FLERR, "Fix cdem/lid {}: vmax {}: must be positive (m/s), or auto", id, given_cap);
    } else
      error->all(FLERR, "Fix cdem/lid {}: unknown keyword {}; allowed: stress, width, thickness, from, vmax", id,
                 keyword);
  }
  if (!has_stress)
    error->all(FLERR, "Fix cdem/lid {}: stress (Pa) is missing", id);
  if (!(stress >= 0 && std::isfinite(stress)))
    error->all(FLERR, "Fix cdem/lid {}: stress {}: must be 0 or more (Pa, compression)", id, stress);
  if (!(width > 0 && std::isfinite(width)))
    error->all(FLERR, "Fix cdem/lid {}: width {}: must be given and positive (m)", id, width);
  if (!(thickness > 0 && std::isfinite(thickness)))
    error->all(FLERR, "Fix cdem/lid {}: thickness {}: must be given and positive (m)", id, thickness);
  size_vector = NOUTPUTS;
}

void FixCDEMLid::read_stress(Shearbox::DeckWords &words) {
  if (!words.number_follows() && words.left() > 0) {
    const std::string variable = words.word("stress");
    if (utils::strmatch(variable, "^v_")) {
      stress_variable = variable.substr(2);
      return;
    }
    error->all(FLERR, "Fix cdem/lid {}: stress is {}, must be a number (Pa) or v_name", id, variable);
  }
  stress = words.number("stress");
}

void FixCDEMLid::read_side(Shearbox::DeckWords &words) {
  const std::string side = words.word("from");
  if (side != "top" && side != "bottom" && side != "left" && side != "right")
    error->all(FLERR, "Fix cdem/lid {}: from is {}, must be top, bottom, left or right", id, side);
  axis = side == "left" || side == "right" ? X : Y;
  sign = side == "top" || side == "right" ? 1 : -1;
}

void FixCDEMLid::init() {
  WallBody::init();
  mass = total_mass();
  if (stress > 0)
    force_unit = cdem::unit_for(stress * width * thickness);
  if (!(mass > 0))
    error->all(FLERR, "Fix cdem/lid {}: the mass of group {} is {} kg", id, group->names[igroup], mass);
  if (given_cap == 0)
    cap_per_force = 1 / std::sqrt(static_cast<double>(group->count(igroup)) * largest_stiffness() * mass);
  if (!stress_variable.empty()) {
    variable_index = input->variable->find(stress_variable.c_str());
    if (variable_index < 0)
      error->all(FLERR, "Fix cdem/lid {}: there is no variable {}", id, stress_variable);
    if (!input->variable->equalstyle(variable_index))
      error->all(FLERR, "Fix cdem/lid {}: variable {} is not of style equal", id, stress_variable);
  }
  motion.velocity = group_velocity();
  set_motion(outward(motion.velocity), outward(motion.acceleration));
}

WallBody::Vector FixCDEMLid::outward(double amount) const {
  return axis == X ? Vector{sign * amount, 0} : Vector{0, sign * amount};
}

// The velocity that all discs have. If they differ (a new lid, or one that was set in motion by hand): momentum over
// mass.
double FixCDEMLid::group_velocity() const {
  double extremes[2] = {-INFINITY, -INFINITY}, all[2]; // largest velocity outward, and inward
  for (int i = 0; i < atom->nlocal; i++) {
    if (!in_group(i))
      continue;
    extremes[0] = std::max(extremes[0], sign * atom->v[i][axis]);
    extremes[1] = std::max(extremes[1], -sign * atom->v[i][axis]);
  }
  MPI_Allreduce(extremes, all, 2, MPI_DOUBLE, MPI_MAX, world);
  return all[0] == -all[1] ? all[0] : sign * momentum(axis) / mass;
}

double FixCDEMLid::largest_stiffness() const {
  const auto *pair = dynamic_cast<PairCDEM *>(force->pair);
  if (!pair)
    error->all(FLERR, "Fix cdem/lid {}: vmax auto needs pair_style cdem; give vmax V (m/s) without it", id);
  double kn = 0;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = 1; j <= atom->ntypes; j++)
      kn = std::max(kn, pair->material(i, j).kn);
  if (!(kn > 0))
    error->all(FLERR, "Fix cdem/lid {}: vmax auto: no contact has a normal stiffness; give vmax V (m/s)", id);
  return kn;
}

void FixCDEMLid::update_stress() {
  if (stress_variable.empty())
    return;
  modify->clearstep_compute();
  stress = input->variable->compute_equal(variable_index);
  modify->addstep_compute(update->ntimestep + 1);
  if (!(stress >= 0 && std::isfinite(stress)))
    error->all(FLERR, "Fix cdem/lid {}: variable {} is {} at step {}: must be 0 or more (Pa, compression)", id,
               stress_variable, stress, update->ntimestep);
}

void FixCDEMLid::take_acceleration() {
  felt_force = sign * total_force(axis);
  motion.acceleration = (felt_force - stress * width * thickness) / mass;
}

// As final_integrate() ends a step, for the forces that are there. At its cap the lid moves uniformly.
void FixCDEMLid::start() {
  take_acceleration();
  if (motion.velocity <= -fastest() && motion.acceleration < 0)
    motion.acceleration = 0;
  set_motion(outward(motion.velocity), outward(motion.acceleration));
  book_start(outward(felt_force));
}

// Other fixes may still add to the forces in their setup(): so the first step starts anew.
void FixCDEMLid::setup(int) {
  update_stress();
  start();
  is_first = true;
}

void FixCDEMLid::initial_integrate(int) {
  if (is_first)
    start();
  is_first = false;
  motion.begin_step(update->dt, fastest());
  shift(outward(update->dt * motion.velocity), outward(motion.velocity));
}

void FixCDEMLid::final_integrate() {
  update_stress();
  take_acceleration();
  book_work(outward(felt_force));
  motion.end_step(update->dt, fastest());
  set_motion(outward(motion.velocity), outward(motion.acceleration));
}

double FixCDEMLid::fastest() const { return given_cap > 0 ? given_cap : cap_per_force * stress * width * thickness; }

double FixCDEMLid::inner_face() const {
  double innermost = INFINITY, all;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!in_group(i))
      continue;
    double x[3]; // as if LAMMPS had not put it back into a periodic box
    domain->unmap(atom->x[i], atom->image[i], x);
    innermost = std::min(innermost, sign * x[axis] - reach(i));
  }
  MPI_Allreduce(&innermost, &all, 1, MPI_DOUBLE, MPI_MIN, world);
  return sign * all;
}

// From the centre of an atom inward (m). A piece of a straight wall is as thick as long, see fix cdem/shape.
double FixCDEMLid::reach(int i) const {
  const cdem::GrainShape &shape = FixCDEMShape::shape(lmp, atom->type[i]);
  const double radius = atom->radius[i];
  if (shape.is_line()) {
    const cdem::WallLine line = shape.axis(radius);
    return 0.5 * radius + line.half * std::fabs(axis == X ? line.ux : line.uy);
  }
  if (shape.discs().size() == 1)
    return radius;
  const auto [cosine, sine] = cdem::rotation(angle(i));
  double most = -INFINITY;
  for (const auto &[x, y, r] : shape.discs())
    most = std::max(most, r - sign * (axis == X ? cosine * x - sine * y : sine * x + cosine * y));
  return radius * most;
}

double FixCDEMLid::compute_vector(int n) {
  switch (n) {
  case APPLIED:
    return stress;
  case FELT:
    return felt_force / (width * thickness);
  case FACE:
    return inner_face();
  case VELOCITY:
    return motion.velocity;
  case CAPPED_STEPS:
    return motion.capped_steps;
  default:
    return total_force(axis == X ? Y : X);
  }
}

void FixCDEMLid::write_restart(FILE *fp) {
  if (comm->me == 0)
    Shearbox::write_state(fp, Saved{motion.capped_steps, booked});
}

void FixCDEMLid::restart(char *buf) {
  const auto saved = Shearbox::read_state<Saved>(lmp, style, buf);
  motion.capped_steps = saved.capped_steps;
  booked = saved.booked;
}
