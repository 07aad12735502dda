// SPDX-License-Identifier: GPL-2.0-or-later
#include "liggghts/wall_body.h"

#include "liggghts/fix_integrate.h"

#include "atom.h"
#include "domain.h"
#include "group.h"

using namespace LAMMPS_NS;

namespace Liggghts {

WallBody::WallBody(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  if (domain->dimension != 2)
    stop(lmp, "Fix ", style, " ", id, ": dimension is ", domain->dimension, ", must be 2");
  time_integrate = 1;
  vector_flag = 1;
  global_freq = 1;
  extvector = 0;
}

int WallBody::setmask() { return FixConst::INITIAL_INTEGRATE | FixConst::FINAL_INTEGRATE; }

Words WallBody::words_of(int narg, char **arg) const {
  return Words(lmp, std::string("Fix ") + style + " " + id, narg, arg, 3);
}

void WallBody::init() {
  motion = find_fix<FixIntegrate>(lmp);
  if (!motion)
    stop(lmp, "Fix ", style, " ", id, " needs fix cdem/integrate");
  if (count() == 0)
    stop(lmp, "Fix ", style, " ", id, ": group ", group->names[igroup], " has no atoms");
  const double grains = sum([this](int i) { return motion->is_wall(i) ? 0 : 1; });
  if (grains > 0)
    stop(lmp, "Fix ", style, " ", id, ": ", grains, " atoms of group ", group->names[igroup],
         " are also moved by fix cdem/integrate");
}

bool WallBody::in_group(int i) const { return atom->mask[i] & groupbit; }

template <class Term> double WallBody::sum(Term term) const {
  cdem::ExactSum mine;
  for (int i = 0; i < atom->nlocal; i++)
    if (in_group(i))
      mine.add(term(i));
  return over_ranks(lmp, mine);
}

WallBody::Vector WallBody::force() const {
  return {sum([this](int i) { return atom->f[i][0]; }), sum([this](int i) { return atom->f[i][1]; })};
}

double WallBody::total_mass() const {
  double largest = 0; // the unit of the sum: all masses may be small
  for (int i = 0; i < atom->nlocal; i++)
    if (in_group(i))
      largest = std::max(largest, atom->rmass[i]);
  const double unit = cdem::unit_for(-smallest_of_ranks(lmp, -largest));
  return unit * sum([=](int i) { return atom->rmass[i] / unit; });
}

int WallBody::count() const {
  return int(sum([](int) { return 1.0; }));
}

void WallBody::shift(Vector displacement, Vector velocity) const {
  for (int i = 0; i < atom->nlocal; i++) {
    if (!in_group(i))
      continue;
    atom->x[i][0] += displacement.x;
    atom->x[i][1] += displacement.y;
    atom->v[i][0] = velocity.x;
    atom->v[i][1] = velocity.y;
  }
}

void WallBody::set_motion(Vector velocity, Vector acceleration) const {
  for (int i = 0; i < atom->nlocal; i++) {
    if (!in_group(i))
      continue;
    atom->v[i][0] = velocity.x;
    atom->v[i][1] = velocity.y;
    motion->set_acceleration(i, acceleration.x, acceleration.y);
  }
}

} // namespace Liggghts
