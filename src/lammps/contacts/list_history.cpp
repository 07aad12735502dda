// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/list_history.h"

#include "grains/fix_cdem_audit.h"

#include "atom.h"
#include "domain.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace LAMMPS_NS;

// What contacts remember so far is by the law of the last run.
void ListHistory::end_law() {
  audit = FixCDEMAudit::find(lmp);
  move_history_to_grains();
}

void ListHistory::begin_law(FixCDEMHistory *fix) {
  by_grain = fix;
  by_grain->list = this;
  remember_numbers();
}

// Contacts remember the numbers of the law and, for the books, the forces of the dashpots at the end of the last step.
// Setup cannot compute these: there the dashpots take other velocities (see PairCDEM::compute).
void ListHistory::remember_numbers() {
  static constexpr std::array<const char *, 2 + cdem::MOST_NUMBERS> DASHPOTS{
      "dashpot_n", "dashpot_t", "dashpot_1", "dashpot_2", "dashpot_3",
      "dashpot_4", "dashpot_5", "dashpot_6", "dashpot_7", "dashpot_8"};
  std::vector<cdem::Remembered> all = law.remembered();
  for (int d = 0; audit && d < 2 + law.books(); d++)
    all.push_back({DASHPOTS[d], "N", d >= 2});
  by_grain->remember(all);
}

void ListHistory::recall() {
  listed.assign(atom->tag, atom->tag + atom->nlocal + atom->nghost);
  std::vector<int> count(rows.own_grains(), 0); // of the pairs of each grain
  int most = 0;
  pairs.for_each([&](int k) {
    recall(k);
    for (int row : {pairs.a(k), pairs.b(k)})
      if (const int i = rows.grain(row); i < rows.own_grains())
        most = std::max(most, ++count[i]);
  });
  by_grain->expect_at_most(most);
}

// Of a pair whose periodic images are both in the list, in a box that is hardly longer than two grains, only the
// nearest can touch. Grains know a contact by ids alone, and what it remembers must not go to the other image.
bool ListHistory::is_nearest_image(int k) const {
  const auto &a = rows[pairs.a(k)], &b = rows[pairs.b(k)];
  return !(domain->xperiodic && std::fabs(a.x - b.x) > 0.5 * domain->xprd) &&
         !(domain->yperiodic && std::fabs(a.y - b.y) > 0.5 * domain->yprd);
}

void ListHistory::recall(int k) {
  if (!is_nearest_image(k))
    return;
  const int i = rows.grain(pairs.a(k)), j = rows.grain(pairs.b(k)), p = rows.disc(pairs.a(k)),
            q = rows.disc(pairs.b(k));
  const bool i_is_own = i < atom->nlocal;
  if (const double *const known = i_is_own ? by_grain->find(i, {atom->tag[j], short(p), short(q)})
                                           : by_grain->find(j, {atom->tag[i], short(q), short(p)})) {
    pairs.set_remembered(k, known);
    pairs.set_last_dashpots(k, known + 1 + law.memories());
  }
}

std::vector<ListHistory::Dashpots> ListHistory::dashpots() const {
  std::vector<Dashpots> all;
  if (pairs.has_books())
    pairs.for_each([&](int k) { all.push_back(pairs.last_dashpots_of(k)); });
  return all;
}

// Gives contacts back the forces that their dashpots had before. Where all are 0, the contact is new, or its run was
// not audited.
void ListHistory::take_back(const std::vector<Dashpots> &known) {
  auto next = known.begin();
  pairs.for_each([&](int k) {
    if (std::any_of(next->begin(), next->end(), [](double x) { return x != 0; }))
      pairs.set_last_dashpots(k, next->data());
    ++next;
  });
}

// Grains that arrive in this step have no rows yet, and may have taken the place of ghosts among the atoms. A fix that
// has moved or taken away grains of some ranks has had their histories moved to the grains: then nobody's list is
// whole.
void ListHistory::close_list() {
  if (audit && all_have_history()) {
    rows.fill(0, rows.own_grains(), 0);
    rows.exchange_ghosts();
    finish_step_in_books();
  }
  move_history_to_grains();
}

bool ListHistory::all_have_history() const {
  const int mine = in_list;
  int all;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MIN, world);
  return all;
}

// The rows have moved, and a new list will not know the dashpots' forces at the beginning of this step. This books the
// half of them that belongs to this step; the new list books the other half, from the forces at its end.
void ListHistory::finish_step_in_books() {
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

void ListHistory::book_losses() {
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
void ListHistory::copy_history_to_grains() {
  if (!in_list)
    return;
  if (update->whichflag != 0) // else they were booked at the end of the run, and the audit may be gone
    book_losses();
  const int own_grains = rows.own_grains();
  const int memories = 1 + law.memories(), numbers = memories + numbers_of_books();
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
  by_grain->make_room(count, listed);
  for_each_memory([this](int i, const auto &contact, const double *all) { by_grain->add(i, contact, all); });
}

void ListHistory::move_history_to_grains() {
  copy_history_to_grains();
  in_list = false;
}
