// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/disc_pair_list.h"

#include "core/step_events.h"
#include "grains/fix_cdem_audit.h"
#include "grains/fix_cdem_grains.h"

#include "atom.h"
#include "domain.h"
#include "neighbor.h"
#include "timer.h"
#include "update.h"

#include <algorithm>
#include <array>
#include <cmath>

using namespace LAMMPS_NS;

void DiscPairList::init(const cdem::LawTable &of_run, const PairValues::ByTypes &by_types, const std::string &widest,
                        FixCDEMHistory *memory, bool forces_are_read) {
  audit = FixCDEMAudit::find(lmp);
  move_history_to_grains(); // what the contacts of the last run remember, by its law
  law = of_run;
  coefficients = &by_types;
  instructions = widest;
  keeps_forces = forces_are_read;
  history = memory;
  history->list = this;
  remember_numbers();
  grains = FixCDEMGrains::find(lmp);
  values.init(by_types, grains);
  rows.init(grains, cdem::kernels(law.rules, instructions));
  search.init(grains);
  speed = -1;
  is_of_run = false;
}

// Contacts remember the numbers of the law and, for the books, the forces of the dashpots at the end of the last step.
// Setup cannot compute these: there the dashpots take other velocities (see PairCDEM::compute).
void DiscPairList::remember_numbers() {
  static constexpr std::array<const char *, 2 + cdem::MOST_NUMBERS> DASHPOTS{
      "dashpot_n", "dashpot_t", "dashpot_1", "dashpot_2", "dashpot_3",
      "dashpot_4", "dashpot_5", "dashpot_6", "dashpot_7", "dashpot_8"};
  std::vector<cdem::Remembered> all = law.remembered();
  for (int d = 0; audit && d < 2 + law.books(); d++)
    all.push_back({DASHPOTS[d], "N", d >= 2});
  history->remember(all);
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
  has_history = true;
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
  std::vector<Dashpots> at_end_of_step;
  if (update->setupflag && pairs.has_books())
    pairs.for_each([&](int k) { at_end_of_step.push_back(pairs.last_dashpots_of(k)); });
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
    take_back(at_end_of_step);
}

// Gives contacts back the forces that their dashpots had before. Where all are 0, the contact is new, or its run was
// not audited.
void DiscPairList::take_back(const std::vector<Dashpots> &known) {
  auto next = known.begin();
  pairs.for_each([&](int k) {
    if (std::any_of(next->begin(), next->end(), [](double x) { return x != 0; }))
      pairs.set_last_dashpots(k, next->data());
    ++next;
  });
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
  finish_step_in_books();
  copy_history_to_grains();
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
  booking = audit != nullptr;
  is_of_run = true;
  law.rules.books = booking;
  kernels = cdem::kernels(law.rules, instructions);
  pairs_of_discs.reset();
  listed.assign(atom->tag, atom->tag + atom->nlocal + atom->nghost);
  divide_into_blocks();
  find_pairs();
  set_constants();
  pairs.for_each([this](int k) { recall_history(k); });
  std::vector<int> row_starts;
  for (int grain : block_starts)
    row_starts.push_back(rows.rows_of(grain));
  slots.build(
      // The order of all sums: by the id of the grain, then by the disc.
      pairs, row_starts, [this](int p) { return std::pair(atom->tag[rows.grain(p)], rows.disc(p)); },
      [this](int p) { return !grains->is_free(rows.grain(p)); });
  if (rows.has_lines())
    feet.take_over(pairs);
  history->expect_at_most(most_pairs());
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

// Largest number of pairs of an own grain.
int DiscPairList::most_pairs() const {
  int most = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    int n = 0;
    for (int p = rows.rows_of(i); p < rows.rows_of(i + 1); p++)
      n += slots.pairs_of(p);
    most = std::max(most, n);
  }
  return most;
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
              {law.memories(), law.constants(), booking ? 2 + law.books() : 0, keeps_forces}, pairs);
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

// Of a pair whose periodic images are both in the list, in a box that is hardly longer than two grains, only the
// nearest can touch. Grains know a contact by ids alone, and what it remembers must not go to the other image.
bool DiscPairList::is_nearest_image(int k) const {
  const auto &a = rows[pairs.a(k)], &b = rows[pairs.b(k)];
  return !(domain->xperiodic && std::fabs(a.x - b.x) > 0.5 * domain->xprd) &&
         !(domain->yperiodic && std::fabs(a.y - b.y) > 0.5 * domain->yprd);
}

void DiscPairList::recall_history(int k) {
  if (!is_nearest_image(k))
    return;
  const int i = rows.grain(pairs.a(k)), j = rows.grain(pairs.b(k)), p = rows.disc(pairs.a(k)),
            q = rows.disc(pairs.b(k));
  const bool i_is_own = i < atom->nlocal;
  if (const double *const known = i_is_own ? history->find(i, {atom->tag[j], short(p), short(q)})
                                           : history->find(j, {atom->tag[i], short(q), short(p)})) {
    pairs.set_remembered(k, known);
    pairs.set_last_dashpots(k, known + 1 + law.memories());
  }
}

// Grains that arrive in this step have no rows yet, and may have taken the place of ghosts among the atoms. A fix that
// has moved or taken away grains of some ranks has had their histories moved to the grains: then nobody's list is
// whole.
void DiscPairList::close_list() {
  if (audit && all_have_history()) {
    rows.fill(0, block_starts.back(), 0);
    rows.exchange_ghosts();
    finish_step_in_books();
  }
  move_history_to_grains();
}

bool DiscPairList::all_have_history() const {
  const int mine = has_history;
  int all;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MIN, world);
  return all;
}

// The rows have moved, and a new list will not know the dashpots' forces at the beginning of this step. This books the
// half of them that belongs to this step; the new list books the other half, from the forces at its end.
void DiscPairList::finish_step_in_books() {
  if (!pairs.has_books())
    return;
  if (rows.has_lines())
    feet.place_all();
  pairs.for_each([this](int k) {
    const auto relative = cdem::relative(rows[pairs.a(k)], rows[pairs.b(k)]);
    const auto contact = cdem::contact_of(relative, cdem::distance_of(relative), pairs.constants(k), update->dt);
    auto last = pairs.last_dashpots_of(k);
    pairs.dashpots[k] += law.finish_books(contact, update->dt, last.data());
    pairs.set_last_dashpots(k, last.data());
  });
}

void DiscPairList::book_losses() {
  if (!audit || !pairs.has_books())
    return;
  pairs.for_each([this](int k) {
    if (values.counts(k)) {
      audit->books.friction += pairs.friction[k];
      audit->books.dashpots += pairs.dashpots[k];
    }
    pairs.friction[k] = pairs.dashpots[k] = 0;
  });
}

// Grains may have arrived or left since the list was built. So this uses only what was stored then: the atoms' arrays
// may be those of other grains.
void DiscPairList::copy_history_to_grains() {
  if (!has_history)
    return;
  if (update->whichflag != 0) // else they were booked at the end of the run, and the audit may be gone
    book_losses();
  const int own_grains = block_starts.back();
  const int memories = 1 + law.memories(), numbers = memories + (booking ? 2 + law.books() : 0);
  auto for_each_memory = [&](auto visit) { // visit(grain, contact as it remembers it, its numbers)
    pairs.for_each([&](int k) {
      std::array<double, FixCDEMHistory::MOST> all{};
      const auto of_law = pairs.remembered(k);
      std::copy_n(of_law.begin(), memories, all.begin());
      const auto dashpots = pairs.last_dashpots_of(k);
      std::copy_n(dashpots.begin(), numbers - memories, all.begin() + memories);
      if (std::all_of(all.begin(), all.begin() + numbers, [](double x) { return x == 0; }))
        return;
      const int a = pairs.a(k), b = pairs.b(k);
      for (const auto &[own, other] : {std::pair{a, b}, std::pair{b, a}})
        if (rows.grain(own) < own_grains)
          visit(rows.grain(own),
                FixCDEMHistory::Contact{listed[rows.grain(other)], short(rows.disc(own)), short(rows.disc(other))},
                all.data());
    });
  };
  std::vector<int> count(own_grains, 0);
  for_each_memory([&](int i, const auto &, const double *) { count[i]++; });
  history->make_room(count, listed);
  for_each_memory([this](int i, const auto &contact, const double *all) { history->add(i, contact, all); });
}

void DiscPairList::move_history_to_grains() {
  copy_history_to_grains();
  has_history = false;
}
