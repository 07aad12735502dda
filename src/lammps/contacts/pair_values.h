// SPDX-License-Identifier: GPL-2.0-or-later
// What single pairs of the list are, for code that looks at one of them: mass, overlap, force, energy and so on.
// Changes nothing.
#pragma once

#include "core/disc_pairs.h"
#include "core/law_table.h"
#include "grains/grain_rows.h"

#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

class FixCDEMGrains;

class PairValues : protected Pointers {
public:
  // Coefficients by the types of two atoms, from 1 on; index 0 is not used.
  using ByTypes = std::vector<std::vector<cdem::Coefficients>>;

  PairValues(LAMMPS *lmp, const GrainRows &of_grains, const cdem::DiscPairs &of_discs, const cdem::LawTable &of_run)
      : Pointers(lmp), rows(of_grains), pairs(of_discs), law(of_run) {}
  void init(const ByTypes &, const FixCDEMGrains *);

  // --- of pair k ---
  double mass(int k) const; // reduced mass of the two grains, or that of the grain against a wall (kg)
  double overlap(int k) const;
  // Whether its discs overlap, or still exert this force: a part of it may act on after the contact opened within a
  // step.
  bool acts(int k, const cdem::PairForce &) const;
  // On disc a in the last step of LAMMPS (N). An error if forces are not kept.
  const cdem::PairForce &force(int k) const;
  bool counts(int k) const; // whether this rank is the one that counts it
  const cdem::Coefficients &coefficients(int k) const;
  cdem::LawTable::Energy energy(int k) const;
  cdem::Resistance resistance(int k) const;

private:
  const GrainRows &rows;
  const cdem::DiscPairs &pairs;
  const cdem::LawTable &law;
  const ByTypes *by_types = nullptr;
  const FixCDEMGrains *grains = nullptr;
};

} // namespace LAMMPS_NS
