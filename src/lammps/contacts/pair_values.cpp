// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/pair_values.h"

#include "grains/fix_cdem_grains.h"

#include "atom.h"
#include "error.h"

#include <cmath>

using namespace LAMMPS_NS;

void PairValues::init(const ByTypes &coefficients, const FixCDEMGrains *fix) {
  by_types = &coefficients;
  grains = fix;
}

double PairValues::mass(int k) const {
  const int i = rows.grain(pairs.a(k)), j = rows.grain(pairs.b(k));
  const double mi = atom->rmass[i], mj = atom->rmass[j];
  return !grains->is_free(j) ? mi : !grains->is_free(i) ? mj : mi * mj / (mi + mj);
}

double PairValues::overlap(int k) const {
  const auto &a = rows[pairs.a(k)], &b = rows[pairs.b(k)];
  const double dx = a.x - b.x, dy = a.y - b.y;
  return pairs.constants(k).radius_sum - std::sqrt(dx * dx + dy * dy);
}

bool PairValues::acts(int k, const cdem::PairForce &f) const { return overlap(k) > 0 || f.fx != 0 || f.fy != 0; }

const cdem::PairForce &PairValues::force(int k) const {
  if (pairs.force.empty())
    error->one(FLERR, "Pair style cdem: forces of single contacts are not kept if no compute is there that may "
                      "look at them as a run begins");
  return pairs.force[k];
}

// A pair across a border is on two ranks (or twice on one, if periodic): the owner of disc a counts it.
bool PairValues::counts(int k) const { return rows.grain(pairs.a(k)) < rows.own_grains(); }

const cdem::Coefficients &PairValues::coefficients(int k) const {
  return (*by_types)[atom->type[rows.grain(pairs.a(k))]][atom->type[rows.grain(pairs.b(k))]];
}

cdem::LawTable::Energy PairValues::energy(int k) const {
  return law.energy(coefficients(k).material, pairs.law_constants(k).data(), pairs.remembered(k).data(), overlap(k));
}

cdem::Resistance PairValues::resistance(int k) const {
  const cdem::Material &m = coefficients(k).material;
  const double scale = 2 * std::sqrt(mass(k));
  cdem::Resistance r = law.added_resistance(pairs.law_constants(k).data());
  r.normal.stiffness += m.kn, r.normal.dashpot += m.dn * scale;
  r.tangent.stiffness += m.ks, r.tangent.dashpot += m.ds * scale;
  return r;
}
