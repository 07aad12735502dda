// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/cell_fields.h"

#include "contacts/pair_cdem.h"
#include "core/rotation.h"
#include "grains/fix_cdem_grains.h"
#include "grains/fix_cdem_shape.h"

#include "atom.h"
#include "domain.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

using cdem::CellMeans;

namespace {

const std::vector<CellFields::Field> all_fields = {
    {"solid", [](const CellMeans &c) { return c.solid; }},
    {"grains", [](const CellMeans &c) { return c.grains; }},
    {"mass", [](const CellMeans &c) { return c.mass; }},
    {"coordination", [](const CellMeans &c) { return c.coordination; }},
    {"stress_xx", [](const CellMeans &c) { return c.stress.xx; }},
    {"stress_yy", [](const CellMeans &c) { return c.stress.yy; }},
    {"stress_xy", [](const CellMeans &c) { return c.stress.xy; }},
    {"stress_yx", [](const CellMeans &c) { return c.stress.yx; }},
    {"kinetic_xx", [](const CellMeans &c) { return c.kinetic.xx; }},
    {"kinetic_yy", [](const CellMeans &c) { return c.kinetic.yy; }},
    {"kinetic_xy", [](const CellMeans &c) { return c.kinetic.xy; }},
    {"velocity_x", [](const CellMeans &c) { return c.velocity.x; }},
    {"velocity_y", [](const CellMeans &c) { return c.velocity.y; }},
    {"spin", [](const CellMeans &c) { return c.spin; }},
    {"gradient_xx", [](const CellMeans &c) { return c.gradient.xx; }},
    {"gradient_yy", [](const CellMeans &c) { return c.gradient.yy; }},
    {"gradient_xy", [](const CellMeans &c) { return c.gradient.xy; }},
    {"gradient_yx", [](const CellMeans &c) { return c.gradient.yx; }},
    {"fabric_xx", [](const CellMeans &c) { return c.fabric.xx; }},
    {"fabric_yy", [](const CellMeans &c) { return c.fabric.yy; }},
    {"fabric_xy", [](const CellMeans &c) { return c.fabric.xy; }},
    {"normal_xx", [](const CellMeans &c) { return c.normal.xx; }},
    {"normal_yy", [](const CellMeans &c) { return c.normal.yy; }},
    {"normal_xy", [](const CellMeans &c) { return c.normal.xy; }},
    {"tangential_xx", [](const CellMeans &c) { return c.tangential.xx; }},
    {"tangential_yy", [](const CellMeans &c) { return c.tangential.yy; }},
    {"tangential_xy", [](const CellMeans &c) { return c.tangential.xy; }},
};

cdem::Point moved(cdem::Point p, cdem::Point by) { return {p.x + by.x, p.y + by.y}; }

// The shape of a grain where it is.
void place(const cdem::GrainShape &shape, cdem::Point at, double radius, double angle, cdem::Outline &outline) {
  const auto [cosine, sine] = cdem::rotation(angle);
  outline.clear();
  for (const auto &[x, y, r, from, to] : shape.outline())
    outline.push_back({at.x + radius * (cosine * x - sine * y), at.y + radius * (sine * x + cosine * y), radius * r,
                       from + angle, to + angle});
}

} // namespace

CellFields::CellFields(LAMMPS *lmp, int group_bit, Shearbox::DeckWords words, char **arg,
                       const std::vector<Field> &before)
    : Pointers(lmp), who(words.who), group_bit(group_bit), within(lmp, who, words) {
  std::vector<Field> known = before;
  known.insert(known.end(), all_fields.begin(), all_fields.end());
  fields = Shearbox::choose_fields(lmp, who, words.left(), arg + words.read(), known);
}

void CellFields::init() {
  pair = PairCDEM::needed_by(who, lmp);
  grains = FixCDEMGrains::find(lmp); // the pair style has seen that there is one
  within.init();
}

bool CellFields::counts(int i) const {
  return i < atom->nlocal && (atom->mask[i] & group_bit) && !pair->contacts.rows.shape_of_type(atom->type[i]).is_line();
}

std::vector<std::vector<double>> CellFields::rows(int nx, int ny) {
  if (!pair) // made after the last run, and the next is one with "pre no"
    init();
  const std::vector<Contact> contacts = pair->report.contacts();
  const cdem::Rectangle in = within.rectangle();
  cdem::FieldSums sums(in, nx, ny, largest(contacts));
  add_grains(sums, in, contacts);
  add_branches(sums, in, contacts);

  const std::vector<std::int64_t> mine = sums.words();
  std::vector<std::int64_t> all(mine.size());
  MPI_Allreduce(mine.data(), all.data(), int(mine.size()), MPI_INT64_T, MPI_SUM, world);
  sums.set_words(all);

  std::vector<std::vector<double>> rows;
  for (int k = 0; k < sums.cells(); k++) {
    const CellMeans means = sums.means(k);
    std::vector<double> &row = rows.emplace_back();
    for (const Field &f : fields)
      row.push_back(f.value(means));
  }
  return rows;
}

cdem::FieldSums::Largest CellFields::largest(const std::vector<Contact> &contacts) const {
  double mine[5] = {0, 0, 0, 0, 0}, all[5];
  const auto raise = [&mine](int k, double value) { mine[k] = std::max(mine[k], value); };
  for (int i = 0; i < atom->nlocal; i++) {
    if (!counts(i))
      continue;
    raise(0, atom->radius[i]);
    raise(1, atom->rmass[i]);
    raise(2, std::max(std::fabs(atom->v[i][0]), std::fabs(atom->v[i][1])));
    raise(3, std::fabs(atom->omega[i][2]));
  }
  for (const Contact &c : contacts)
    if (counts(c.grain_a) || counts(c.grain_b))
      raise(4, std::max(std::fabs(c.fn), std::fabs(c.ft)));
  MPI_Allreduce(mine, all, 5, MPI_DOUBLE, MPI_MAX, world);
  return {all[0], all[1], all[2], all[3], all[4]};
}

// Calls visit(displacement, velocity) for the periodic images of what is inside `part` that may reach into the
// rectangle `in`, which may be anywhere. The box may be tilted. The velocity is that of the image over that of the
// grain, if fix deform gives its images one (remap v).
template <class Visit>
void CellFields::for_each_image(const cdem::Rectangle &in, const cdem::Rectangle &part, Visit visit) const {
  const double px = domain->xperiodic ? domain->xprd : 0, py = domain->yperiodic ? domain->yprd : 0;
  const auto first = [](double least, double period) { return period > 0 ? bigint(std::ceil(least / period)) : 0; };
  const auto last = [](double most, double period) { return period > 0 ? bigint(std::floor(most / period)) : 0; };
  const double *const rate = domain->h_rate;
  for (bigint j = first(in.ylo - part.yhi, py); j <= last(in.yhi - part.ylo, py); j++) {
    const double tilt = double(j) * domain->xy;
    for (bigint i = first(in.xlo - part.xhi - tilt, px); i <= last(in.xhi - part.xlo - tilt, px); i++)
      visit(cdem::Point{double(i) * px + tilt, double(j) * py},
            cdem::Point{double(i) * rate[0] + double(j) * rate[5], double(j) * rate[1]});
  }
}

void CellFields::add_grains(cdem::FieldSums &sums, const cdem::Rectangle &in, const std::vector<Contact> &all) const {
  std::vector<int> contacts(atom->nlocal, 0);
  for (const Contact &c : all)
    for (int i : {c.grain_a, c.grain_b})
      if (c.overlap > 0 && i < atom->nlocal)
        contacts[i]++;

  std::vector<const cdem::GrainShape *> shapes(1, nullptr);
  for (int type = 1; type <= atom->ntypes; type++)
    shapes.push_back(&FixCDEMShape::shape(lmp, type));

  cdem::Outline outline;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!counts(i))
      continue;
    const cdem::GrainShape &shape = *shapes[atom->type[i]];
    const double r = atom->radius[i];
    const cdem::Point centre{atom->x[i][0], atom->x[i][1]};
    const cdem::Point velocity{atom->v[i][0], atom->v[i][1]};
    const bool drifts = domain->deform_vremap && (atom->mask[i] & domain->deform_groupbit);
    for_each_image(in, {centre.x - r, centre.x + r, centre.y - r, centre.y + r},
                   [&](cdem::Point by, cdem::Point drift) {
                     const cdem::Point at = moved(centre, by);
                     place(shape, at, r, grains->angle(i), outline);
                     sums.add({at, drifts ? moved(velocity, drift) : velocity, r, shape.area() * r * r, atom->rmass[i],
                               atom->omega[i][2], contacts[i]},
                              outline);
                   });
  }
}

// Each rank takes the ends of contacts at its own grains.
void CellFields::add_branches(cdem::FieldSums &sums, const cdem::Rectangle &in,
                              const std::vector<Contact> &contacts) const {
  const auto add = [&](const Contact &c, int i, double sign) {
    if (!counts(i))
      return;
    const cdem::Point force{sign * (c.fn * c.nx - c.ft * c.ny), sign * (c.fn * c.ny + c.ft * c.nx)};
    const cdem::Point from{atom->x[i][0], atom->x[i][1]}, to{c.x, c.y};
    const auto [xlo, xhi] = std::minmax(from.x, to.x);
    const auto [ylo, yhi] = std::minmax(from.y, to.y);
    for_each_image(in, {xlo, xhi, ylo, yhi}, [&](cdem::Point by, cdem::Point) {
      sums.add({moved(from, by), moved(to, by), force, {c.nx, c.ny}, c.fn, c.ft});
    });
  };
  for (const Contact &c : contacts) {
    add(c, c.grain_a, 1);
    add(c, c.grain_b, -1);
  }
}
