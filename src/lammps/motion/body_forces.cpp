// SPDX-License-Identifier: GPL-2.0-or-later
#include "motion/body_forces.h"

#include "grains/fix_cdem_audit.h"
#include "grains/fix_cdem_grains.h"
#include "grains/grain_rows.h"

#include "atom.h"
#include "error.h"
#include "update.h"

#include <algorithm>
#include <utility>

using namespace LAMMPS_NS;

bool BodyForces::parse(Shearbox::DeckWords &words) {
  if (words.take("gravity")) {
    for (double &component : gravity)
      component = words.finite("gravity");
  } else if (words.take("drag")) {
    read_drag(words);
  } else if (words.take("damping")) {
    damping = words.finite("damping");
    if (!(damping >= 0 && damping < 1))
      error->all(FLERR, "Fix cdem/integrate: damping {}: must be from 0 to less than 1 (share of the force)", damping);
  } else {
    return false;
  }
  return true;
}

void BodyForces::read_drag(Shearbox::DeckWords &words) {
  drag = 0;
  if (words.take("none"))
    return;
  const double time = words.finite("drag");
  if (!(time > 0))
    error->all(FLERR, "Fix cdem/integrate: drag {}: the time must be positive (s), or none", time);
  drag = 1 / time;
}

void BodyForces::tell_grains() {
  grains = FixCDEMGrains::find(lmp);
  std::copy_n(gravity, 2, grains->gravity);
  grains->drag = drag;
  grains->damping = damping;
  if (auto *const books = FixCDEMAudit::find(lmp)) // `audit` is that of the last run
    books->take_gravity();
}

void BodyForces::init() { audit = FixCDEMAudit::find(lmp); }

// Asked by the run style, whose init() is before ours: `audit` is still that of the last run.
bool BodyForces::books_forces() const { return damping != 0 && FixCDEMAudit::find(lmp); }

void BodyForces::add() {
  if (!grains->step_rule().has_body_forces())
    return;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!grains->is_free(i))
      continue;
    for (int k = 0; k < 2; k++)
      atom->f[i][k] += atom->rmass[i] * (gravity[k] - drag * atom->v[i][k]);
  }
  if (!update->setupflag)
    book_drag_at([this](int i) { return std::pair(atom->v[i][0], atom->v[i][1]); });
  if (damping != 0)
    damp();
}

void BodyForces::damp() {
  double lost = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!grains->is_free(i))
      continue;
    const FixCDEMGrains::Inverse inverse = grains->inverse(i);
    for (int k = 0; k < 2; k++)
      damp(atom->f[i][k], atom->v[i][k], inverse.mass, lost);
    damp(atom->torque[i][2], atom->omega[i][2], inverse.inertia, lost);
  }
  if (audit && !update->setupflag)
    audit->books.drag += update->dt * lost;
}

// Adds to `lost` the power that damping takes out (W), at the velocity in the middle of the kick: that of the half step
// is half a step behind.
void BodyForces::damp(double &force, double velocity, double inverse_mass, double &lost) const {
  const double resistance = damping * cdem::opposing(force, velocity);
  force += resistance;
  lost -= resistance * (velocity + 0.5 * update->dt * inverse_mass * force);
}

void BodyForces::book_drag(const GrainRows &rows) {
  book_drag_at([&](int i) { return std::pair(rows.of_grain(i).vx_half, rows.of_grain(i).vy_half); });
}

// At the velocity of the half step, in the middle of the step that is booked.
template <class Velocity> void BodyForces::book_drag_at(Velocity velocity) {
  if (!audit || drag == 0)
    return;
  double power = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!grains->is_free(i))
      continue;
    const auto [vx, vy] = velocity(i);
    power += drag * atom->rmass[i] * (vx * vx + vy * vy);
  }
  audit->books.drag += update->dt * power;
}
