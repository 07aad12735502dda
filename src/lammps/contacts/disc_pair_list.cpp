// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/disc_pair_list.h"

#include "core/step_events.h"
#include "grains/fix_cdem_grains.h"

#include "atom.h"
#include "neighbor.h"
#include "timer.h"
#include "update.h"

#include <algorithm>
#include <array>
#include <cmath>

using namespace LAMMPS_NS;

void DiscPairList::init(const cdem::LawTable &of_run, const PairValues::ByTypes &by_types, const std::string &widest,
                        FixCDEMHistory *memory, bool forces_are_read) {
  history.end_law();
  law = of_run;
  history.begin_law(memory);
  coefficients = &by_types;
  instructions = widest;
  keeps_forces = forces_are_read;
  grains = FixCDEMGrains::find(lmp);
  values.init(by_types, grains);
  rows.init(grains, cdem::kernels(law.rules, instructions));
  search.init(grains);
  speed = -1;
  is_of_run = false;
}

void DiscPairList::rebuild(const NeighList *of_grains) {
  neighbours = of_grains;
  const double step = cdem::GridPlace::step_for(neighbor->skin);
  neighbours_built_at.resize(atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++)
    neighbours_built_at[i] = {atom->x[i][0], atom->x[i][1], step};
  if (rows.has_lines())
    feet.find_joints();
  build();
}

void DiscPairList::pair_forces(int block) {
  history.take_over();
  const double dt = update->setupflag ? 0 : update->dt;
  if (rows.has_lines()) {
    feet.place(block);
    feet.take_over_contacts(block, pairs, dt);
  }
  cdem::PairColumns columns = pairs.columns(slots.data());
  if (fetches_ahead)
    columns.ahead = {rows.discs() + slots.read_end(block), rows.body(block_starts[block])};
  for (int k = pairs.first_segment[block]; k < pairs.first_segment[block + 1]; k++) {
    const auto &segment = pairs.segments[k];
    kernels.forces(rows.discs(), columns, segment.material, segment.begin, segment.end, dt);
  }
  if (rows.has_lines())
    feet.remember_elsewhere(block, pairs);
}

void DiscPairList::forces(const LookAtForce &visit) {
  std::vector<ListHistory::Dashpots> at_end_of_step;
  if (update->setupflag)
    at_end_of_step = history.dashpots();
  for (int block = 0; block < slots.blocks(); block++) {
    const int begin = block_starts[block], end = block_starts[block + 1];
    pair_forces(block);
    look_at_forces(block, visit);
    rows.sum_block(slots.block(block), begin, end);
    for (int i = begin; i < end; i++) {
      const auto [fx, fy, torque] = rows.force_on(i);
      atom->f[i][0] += fx;
      atom->f[i][1] += fy;
      atom->torque[i][2] += torque;
    }
  }
  if (!at_end_of_step.empty())
    history.take_back(at_end_of_step);
}

// Later blocks use the slots again.
void DiscPairList::look_at_forces(int block, const LookAtForce &visit) {
  const bool kept = !pairs.force.empty();
  if (!kept && !visit)
    return;
  pairs.for_each_of_block(block, [&](int k) {
    const cdem::PairForce f = slots.of_pair(pairs, k);
    if (kept)
      pairs.force[k] = f;
    if (visit && values.acts(k, f))
      visit(k, f);
  });
}

// A pair belongs to the block of its lower row, so later blocks have no pairs with the grains of this one. Once the
// pairs of a block are done, its grains can be moved, while their forces are still in the cache.
void DiscPairList::forces_and_advance(const cdem::StepRule &step, const std::vector<int> &felt, cdem::Fastest &fastest,
                                      cdem::Travel *travel) {
  auto wall = felt.begin();
  for (int block = 0; block < slots.blocks(); block++) {
    const int begin = block_starts[block], end = block_starts[block + 1];
    pair_forces(block);
    for (; wall != felt.end() && *wall < end; ++wall) {
      rows.sum_grain(slots, *wall);
      const auto [fx, fy, torque] = rows.force_on(*wall);
      atom->f[*wall][0] = fx;
      atom->f[*wall][1] = fy;
    }
    rows.advance(slots.block(block), begin, end, step, fastest, travel);
  }
}

double DiscPairList::room() const {
  const double step = cdem::GridPlace::step_for(neighbor->skin);
  double most = 0; // infinite: then the list is rebuilt, but before that the guard ends the run and names the atom
  for (int i = 0; i < atom->nlocal; i++)
    most = std::max(most, neighbours_built_at[i].moved_to(rows.of_grain(i).x, rows.of_grain(i).y, step));
  return 0.5 * neighbor->skin - most;
}

// Bound on how far any point of a grain has moved since the list of disc pairs was built (m).
double DiscPairList::most_moved() const {
  const double step = cdem::GridPlace::step_for(skin);
  double most = 0;
  for (std::size_t i = 0; i < discs_built_at.size(); i++) {
    double moved = discs_built_at[i].moved_to(rows.of_grain(i).x, rows.of_grain(i).y, step);
    if (rows.has_clumps())
      moved += rows.reach(i) * std::fabs(rows.angle(i) - angle_built_at[i]);
    if (std::isfinite(moved)) // else the guard will end the run
      most = std::max(most, moved);
  }
  return most;
}

// How far the discs have moved is measured only when the bound on it is used up.
void DiscPairList::refresh(double moved) {
  constexpr double LEAST = 0.05; // of the skin: with less room left, the list is rebuilt
  room_left -= moved;
  if (room_left > 0)
    return;
  room_left = 0.5 * skin - most_moved();
  if (room_left > LEAST * skin)
    return;
  timer->stamp(Timer::PAIR);
  speed = (0.5 * skin - room_left) / double(std::max<bigint>(update->ntimestep - built_in_step, 1));
  history.finish_step_in_books();
  history.copy_history_to_grains();
  build();
  timer->stamp(Timer::NEIGH);
}

void DiscPairList::take_places() {
  rows.fill(0, atom->nlocal, 0);
  room_left = 0;
}

double DiscPairList::largest_reach() const {
  double reach = 0;
  if (rows.has_clumps())
    for (int i = 0; i < atom->nlocal; i++)
      reach = std::max(reach, rows.reach(i));
  return reach;
}

void DiscPairList::build() {
  is_of_run = true;
  law.rules.books = history.has_audit();
  kernels = cdem::kernels(law.rules, instructions);
  pairs_of_discs.reset();
  divide_into_blocks();
  find_pairs();
  set_constants();
  history.recall();
  std::vector<int> row_starts;
  for (int grain : block_starts)
    row_starts.push_back(rows.rows_of(grain));
  slots.build(
      // The order of all sums: by the id of the grain, then by the disc.
      pairs, row_starts, [this](int p) { return std::pair(atom->tag[rows.grain(p)], rows.disc(p)); },
      [this](int p) { return !grains->is_free(rows.grain(p)); });
  if (rows.has_lines())
    feet.take_over(pairs);
  constexpr double SECOND_CACHE = 2e6; // of a core, bytes
  fetches_ahead = pairs.bytes() + rows.bytes() + slots.bytes() > SECOND_CACHE;

  discs_built_at.resize(atom->nlocal + atom->nghost);
  angle_built_at.resize(rows.has_clumps() ? discs_built_at.size() : 0);
  for (std::size_t i = 0; i < discs_built_at.size(); i++)
    discs_built_at[i] = {rows.of_grain(i).x, rows.of_grain(i).y, cdem::GridPlace::step_for(skin)};
  for (std::size_t i = 0; i < angle_built_at.size(); i++)
    angle_built_at[i] = rows.angle(i);
  room_left = 0.5 * skin;
  built_in_step = update->ntimestep;
}

// Blocks are so small that the forces of a block stay in the cache.
void DiscPairList::divide_into_blocks() {
  constexpr int ROWS = 512;
  block_starts.assign(1, 0);
  for (int i = 1; i < atom->nlocal; i++)
    if (rows.rows_of(i + 1) - rows.rows_of(block_starts.back()) > ROWS)
      block_starts.push_back(i);
  block_starts.push_back(atom->nlocal);
}

void DiscPairList::find_pairs() {
  const double step = update->dt * rows.fastest(atom->nlocal + atom->nghost).speed(largest_reach());
  skin = search.cheapest_skin(*neighbours, step, speed);
  std::vector<cdem::Material> materials; // by two types
  for (const auto &row : *coefficients)
    for (const cdem::Coefficients &of_types : row)
      materials.push_back(of_types.material);
  search.find(*neighbours, skin, block_starts, materials,
              {law.memories(), law.constants(), law.rules.books ? 2 + law.books() : 0, keeps_forces}, pairs);
}

const cdem::PairsOfDiscs &DiscPairList::by_disc() const {
  if (!pairs_of_discs)
    pairs_of_discs = slots.by_disc(pairs);
  return *pairs_of_discs;
}

void DiscPairList::set_constants() {
  const cdem::StepRule step = grains->step_rule();
  for (const auto &[material, begin, end] : pairs.segments) {
    const double of_steps = cdem::mass_of_steps(material, step.dt, 2 * step.forward / step.dt);
    for (int k = begin; k < end; k++) {
      const double rp = rows.radius(pairs.a(k)), rq = rows.radius(pairs.b(k));
      pairs.set_constants(k, {rp + rq, 0.5 * (rp - rq), cdem::dashpot_scale(values.mass(k), of_steps)});
      if (law.constants() > 0)
        set_law_constants(k);
    }
  }
}

void DiscPairList::set_law_constants(int k) {
  const int p = pairs.a(k), q = pairs.b(k);
  std::array<double, cdem::MOST_NUMBERS> constants{};
  law.set_constants(values.coefficients(k), {grain_of(p), grain_of(q)}, constants.data());
  pairs.set_law_constants(k, constants.data());
}

cdem::TwoGrains::Grain DiscPairList::grain_of(int row) const {
  const int i = rows.grain(row);
  if (!grains->is_free(i))
    return {INFINITY, INFINITY, rows.radius(row)};
  const double m = atom->rmass[i], r = atom->radius[i];
  return {m, grains->inertia(atom->type[i]) * m * r * r, rows.radius(row)};
}

void DiscPairList::renew_constants() {
  const bool running = update->whichflag != 0; // else atoms may have been added or removed since the list was built
  if (running && is_of_run)
    set_constants();
}
