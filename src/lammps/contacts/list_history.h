// SPDX-License-Identifier: GPL-2.0-or-later
// What the contacts of the list of disc pairs remember, and the energy that they have lost. It is in the columns of the
// pairs, and goes to fix cdem/history when the list is drawn anew, grains change ranks or a restart file is written.
#pragma once

#include "contacts/fix_cdem_history.h"
#include "contacts/line_feet.h"
#include "contacts/pair_values.h"
#include "core/disc_pairs.h"
#include "core/law_table.h"
#include "grains/grain_rows.h"

#include "pointers.h"

#include <array>
#include <vector>

namespace LAMMPS_NS {

class FixCDEMAudit;

class ListHistory final : protected Pointers, public ContactList {
public:
  ListHistory(LAMMPS *lmp, GrainRows &of_grains, cdem::DiscPairs &of_discs, LineFeet &of_lines,
              const cdem::LawTable &of_run, const PairValues &of_pairs)
      : Pointers(lmp), rows(of_grains), pairs(of_discs), feet(of_lines), law(of_run), values(of_pairs) {}

  // As a run begins: to be called before the list gets the law of the run, and after.
  void end_law();
  void begin_law(FixCDEMHistory *);
  bool has_audit() const { return audit; }

  // Gives the pairs of a new list what the grains know of their contacts.
  void recall();
  // From now on the list has the histories, not the grains: they change with its forces.
  void take_over() { in_list = true; }

  void copy_history_to_grains() override;
  void move_history_to_grains() override;
  void close_list() override;
  void book_losses() override; // of the contacts that this rank counts, in fix cdem/audit
  void finish_step_in_books(); // before the list is drawn anew

  // Forces of the dashpots at the end of the last step, of all pairs, if there are books.
  using Dashpots = std::array<double, 2 + cdem::MOST_NUMBERS>;
  std::vector<Dashpots> dashpots() const;
  void take_back(const std::vector<Dashpots> &);

  double bytes() const { return double(listed.capacity() * sizeof(tagint)); }

private:
  void remember_numbers();
  int numbers_of_books() const { return pairs.has_books() ? 2 + law.books() : 0; }
  bool is_nearest_image(int k) const;
  void recall(int k);
  bool all_have_history() const;

  GrainRows &rows;
  cdem::DiscPairs &pairs;
  LineFeet &feet;
  const cdem::LawTable &law;
  const PairValues &values;
  FixCDEMHistory *by_grain = nullptr;
  FixCDEMAudit *audit = nullptr;
  std::vector<tagint> listed; // ids of all grains, ghosts too, when the list was drawn
  bool in_list = false;       // whether the list has the present histories, not the grains
};

} // namespace LAMMPS_NS
