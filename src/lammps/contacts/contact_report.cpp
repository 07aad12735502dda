// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/contact_report.h"

#include "atom.h"

#include <cmath>

using namespace LAMMPS_NS;

std::vector<ContactReport::Contact> ContactReport::contacts() const {
  std::vector<Contact> all;
  list.pairs.for_each([&](int k) {
    if (list.values.acts(k, list.values.force(k)))
      all.push_back(contact(k));
  });
  return all;
}

ContactReport::Contact ContactReport::contact(int k) const {
  const GrainRows &rows = list.rows;
  const int p = list.pairs.a(k), q = list.pairs.b(k);
  const double dx = rows[p].x - rows[q].x, dy = rows[p].y - rows[q].y, distance = std::sqrt(dx * dx + dy * dy);
  const auto [fx, fy] = list.values.force(k);

  Contact c;
  c.grain_a = rows.grain(p);
  c.grain_b = rows.grain(q);
  c.tag_a = atom->tag[c.grain_a];
  c.tag_b = atom->tag[c.grain_b];
  c.disc_a = rows.disc(p);
  c.disc_b = rows.disc(q);
  c.nx = dx / distance;
  c.ny = dy / distance;
  const auto &constants = list.pairs.constants(k);
  const double lever = 0.5 * distance + constants.half_difference;
  c.x = rows[p].x - lever * c.nx;
  c.y = rows[p].y - lever * c.ny;
  c.fn = fx * c.nx + fy * c.ny;
  c.ft = fy * c.nx - fx * c.ny;
  c.overlap = constants.radius_sum - distance;
  c.sliding = !cdem::is_marked(list.pairs.es(k));
  c.mine = list.values.counts(k);
  c.remembered = list.pairs.remembered(k);
  return c;
}

std::vector<ContactReport::DiscPlace> ContactReport::discs() const {
  const GrainRows &rows = list.rows;
  std::vector<DiscPlace> all;
  for (int p = 0; p < rows.rows_of(atom->nlocal); p++) {
    if (!rows.is_line(p)) {
      all.push_back({rows.grain(p), rows.disc(p), rows[p].x, rows[p].y, rows.radius(p)});
      continue;
    }
    const auto [ux, uy, half] = rows.line(p);
    for (int end : {0, 1}) {
      const double along = end ? half : -half;
      all.push_back({rows.grain(p), end, rows[p].x + along * ux, rows[p].y + along * uy, rows.radius(p)});
    }
  }
  return all;
}

cdem::LawTable::Energy ContactReport::energy() const {
  cdem::LawTable::Energy sum{0, 0, 0};
  list.pairs.for_each([&](int k) {
    if (!list.values.counts(k))
      return;
    const auto [normal, tangential, added] = list.values.energy(k);
    sum.normal += normal;
    sum.tangential += tangential;
    sum.added += added;
  });
  return sum;
}

ContactReport::OfPair ContactReport::of_pair(int i, int j) const {
  const GrainRows &rows = list.rows;
  OfPair sum{0, 0, 0, 0, 0};
  auto add = [&](int k) {
    const int p = list.pairs.a(k), q = list.pairs.b(k), other = rows.grain(p) == i ? rows.grain(q) : rows.grain(p);
    if (atom->tag[other] != atom->tag[j] || !list.values.acts(k, list.values.force(k)))
      return;
    const Contact c = contact(k);
    const auto [normal, tangential, added] = list.values.energy(k);
    sum.energy += normal + tangential + added;
    sum.pull += c.fn / std::hypot(rows[p].x - rows[q].x, rows[p].y - rows[q].y);
    sum.fn += c.fn;
    sum.ft += c.ft;
    sum.es += list.pairs.es(k);
  };
  // Contacts with a piece of a line have the row of its foot.
  if (!rows.is_line(rows.rows_of(i)))
    for (int p = rows.rows_of(i); p < rows.rows_of(i + 1); p++)
      list.by_disc().for_each(p, add);
  else
    list.pairs.for_each([&](int k) {
      if (rows.grain(list.pairs.a(k)) == i || rows.grain(list.pairs.b(k)) == i)
        add(k);
    });
  return sum;
}
