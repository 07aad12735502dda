// SPDX-License-Identifier: GPL-2.0-or-later
#include "grains/grain_rows.h"

#include "grains/fix_cdem_grains.h"
#include "grains/fix_cdem_shape.h"
#include "host/compat.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "update.h"

#include <algorithm>
#include <limits>
#include <utility>

using namespace LAMMPS_NS;

using Disc = cdem::Disc<double>;

void GrainRows::init(FixCDEMGrains *fix, const cdem::Kernels &fastest) {
  states = fix;
  kernels = fastest;
  shapes.assign(1, nullptr);
  for (int type = 1; type <= atom->ntypes; type++)
    shapes.push_back(&FixCDEMShape::shape(lmp, type));
  clumps = std::any_of(shapes.begin() + 1, shapes.end(), [](const auto *s) { return s->discs().size() > 1; });
  lines = std::any_of(shapes.begin() + 1, shapes.end(), [](const auto *s) { return s->is_line(); });
}

void GrainRows::map() {
  own = atom->nlocal, all = own + atom->nghost;
  grains.resize(all);
  radii.clear();
  if (clumps)
    map_clumps();
  else if (lines)
    for (int i = 0; i < all; i++)
      radii.push_back(atom->radius[i] * shapes[atom->type[i]]->discs().front().r);
  make_feet({});
}

void GrainRows::map_clumps() {
  bodies.resize(all);
  first_row.resize(all + 1);
  grain_of_row.clear();
  offsets.clear();
  for (int i = 0; i < all; i++) {
    first_row[i] = int(grain_of_row.size());
    for (const auto &disc : shapes[atom->type[i]]->discs()) {
      grain_of_row.push_back(i);
      offsets.push_back({atom->radius[i] * disc.x, atom->radius[i] * disc.y});
      radii.push_back(atom->radius[i] * disc.r);
    }
  }
  first_row[all] = int(grain_of_row.size());
}

void GrainRows::make_feet(std::vector<int> pieces) {
  piece_of_foot = std::move(pieces);
  first_foot = rows_of(all);
  constexpr std::size_t MOST = std::numeric_limits<int>::max() / 8; // eight numbers each, counted by int
  if (first_foot + piece_of_foot.size() > MOST)
    error->one(
        FLERR,
        "Pair cdem: {} discs and contacts with smooth walls on a rank, ghosts included: at most {}, take more ranks",
        first_foot + piece_of_foot.size(), MOST);
  (clumps ? disc_rows : grains).resize(first_foot + piece_of_foot.size());
}

double GrainRows::reach(int i) const { return atom->radius[i] * shapes[atom->type[i]]->reach(); }

void GrainRows::fill(int begin, int end, double forward) {
  for (int i = begin; i < end; i++)
    fill_grain(i, forward);
  expand(begin, end);
}

// An acceleration that is not known yet is NaN, so it is only read if the velocity is carried forward.
void GrainRows::fill_grain(int i, double forward) {
  const double *const x = atom->x[i], *const v = atom->v[i], omega = atom->omega[i][2];
  Disc &row = grains[i];
  row = {x[0], x[1], v[0], v[1], v[0], v[1], omega, omega};
  if (forward != 0) {
    const FixCDEMGrains::Acceleration a = states->acceleration(i);
    row.vx += forward * a.x;
    row.vy += forward * a.y;
    row.omega += forward * a.turn;
  }
  if (clumps)
    bodies[i].angle = states->angle(i);
}

// A periodic image is shifted by whole periods of the box, which may be tilted. If the box is deformed (fix deform
// remap v), the image also gets the velocity of the deformation.
int GrainRows::pack(int n, const int *list, double *buf, int pbc_flag, const int *pbc) const {
  double dx = 0, dy = 0, dvx = 0, dvy = 0;
  if (pbc_flag) {
    const double *const rate = domain->h_rate;
    dx = pbc[0] * domain->xprd + pbc[5] * domain->xy;
    dy = pbc[1] * domain->yprd;
    dvx = pbc[0] * rate[0] + pbc[5] * rate[5];
    dvy = pbc[1] * rate[1];
  }
  const double *const begin = buf;
  for (int k = 0; k < n; k++) {
    Disc image = grains[list[k]];
    image.x += dx;
    image.y += dy;
    if (domain->deform_vremap && (atom->mask[list[k]] & domain->deform_groupbit)) {
      image.vx_half += dvx, image.vx += dvx;
      image.vy_half += dvy, image.vy += dvy;
    }
    std::copy_n(&image.x, sizeof(Disc) / sizeof(double), buf);
    buf += sizeof(Disc) / sizeof(double);
    if (clumps)
      *buf++ = bodies[list[k]].angle;
  }
  return int(buf - begin);
}

void GrainRows::unpack(int n, int first, const double *buf) {
  for (int i = first; i < first + n; i++) {
    std::copy_n(buf, sizeof(Disc) / sizeof(double), &grains[i].x);
    buf += sizeof(Disc) / sizeof(double);
    if (clumps)
      bodies[i].angle = *buf++;
  }
}

cdem::ClumpColumns GrainRows::columns() {
  return {grains.data(), bodies.data(), first_row.data(), disc_rows.data(), offsets.data(), sums.data(), first_summed};
}

void GrainRows::exchange_ghosts() {
  if (all > own || comm->nprocs > 1)
    Shearbox::forward_comm(lmp, carrier);
  expand(own, all);
}

void GrainRows::expand(int begin, int end) {
  if (clumps)
    kernels.expand(columns(), begin, end, update->setupflag ? 0 : 0.5 * update->dt);
}

int GrainRows::make_sums(int first_grain, int end_grain) {
  first_summed = rows_of(first_grain);
  const int n = rows_of(end_grain) - first_summed;
  if (int(sums.size()) < n) // never shrinks: this is called in every step
    sums.resize(n);
  return n;
}

void GrainRows::sum_block(const cdem::SlotBlock &block, int first_grain, int end_grain) {
  make_sums(first_grain, end_grain);
  kernels.sum(block, sums.data(), first_summed);
}

void GrainRows::sum_grain(const cdem::ForceSlots &slots, int i) {
  const int n = make_sums(i, i + 1);
  for (int k = 0; k < n; k++)
    cdem::store_raw(&sums[k].fx, slots.sum(first_summed + k));
}

cdem::DiscForce GrainRows::force_on(int i) {
  if (!clumps) {
    const auto &sum = sums[i - first_summed];
    return {sum.fx, sum.fy, sum.torque_a};
  }
  const cdem::Four sum = cdem::force_on(columns(), i);
  return {sum[0], sum[1], sum[2]};
}

void GrainRows::take_bodies() {
  bodies.resize(grains.size());
  for (int i = 0; i < atom->nlocal; i++) {
    const auto [mass, inertia] = states->inverse(i);
    bodies[i] = {states->angle(i), atom->rmass[i], mass, inertia};
  }
}

void GrainRows::advance(const cdem::SlotBlock &block, int begin, int end, const cdem::StepRule &step,
                        cdem::Fastest &fastest, cdem::Travel *travel) {
  if (!clumps) {
    kernels.advance(block, grains.data(), bodies.data(), step, fastest, travel);
    return;
  }
  sum_block(block, begin, end);
  kernels.advance_clumps(columns(), begin, end, step, fastest, travel);
}

void GrainRows::shift(const std::vector<int> &walls, Vector displacement, Vector velocity, Vector ahead) {
  for (int i : walls) {
    Disc &row = grains[i];
    row.x += displacement.x;
    row.y += displacement.y;
    row.vx_half = velocity.x;
    row.vy_half = velocity.y;
    row.vx = ahead.x;
    row.vy = ahead.y;
  }
  if (clumps)
    for (int i : walls)
      expand(i, i + 1);
}

void GrainRows::write_back() {
  for (int i = 0; i < atom->nlocal; i++) {
    const Disc &row = grains[i];
    atom->x[i][0] = row.x;
    atom->x[i][1] = row.y;
    atom->v[i][0] = row.vx_half;
    atom->v[i][1] = row.vy_half;
    atom->omega[i][2] = row.omega_half;
    states->angle(i) = bodies[i].angle;
  }
}

cdem::Fastest GrainRows::fastest(int n) const {
  cdem::Fastest fastest;
  for (int i = 0; i < n; i++) {
    const Disc &row = grains[i];
    fastest.see(cdem::Four{row.vx_half * row.vx_half, row.vy_half * row.vy_half, row.omega_half * row.omega_half, 0});
  }
  return fastest;
}

double GrainRows::bytes() const {
  return double((grains.capacity() + disc_rows.capacity()) * sizeof(Disc) + bodies.capacity() * sizeof(cdem::Body) +
                sums.capacity() * sizeof(sums[0]) + (first_row.capacity() + grain_of_row.capacity()) * sizeof(int) +
                offsets.capacity() * sizeof(cdem::Offset) + radii.capacity() * sizeof(double));
}
