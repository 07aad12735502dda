// SPDX-License-Identifier: GPL-2.0-or-later
// The contact laws of laws.h as the rest of the program sees them: by name, and as tables of numbers and functions.
#pragma once

#include "declaration.h"
#include "kinematics.h"
#include "material.h"
#include "rules.h"

#include <string>
#include <vector>

namespace cdem {

std::vector<std::string> accumulation_names();

// Names of the numbers that contacts can remember, over all laws.
std::vector<std::string> all_remembered();

// Parameters of pair_coeff: the first group has those of the contact law itself and no name; then one group an
// addition.
struct ParameterGroup {
  std::string name;
  std::vector<Parameter> parameters;
};
const std::vector<ParameterGroup> &parameter_groups();

// Coefficients of two atom types: parameters in the order of the groups, 0 for additions that were not given.
struct Coefficients {
  std::vector<double> given;
  Material material;

  Coefficients() = default;
  explicit Coefficients(std::vector<double> given);
};

// The law in use.
class LawTable {
public:
  LawTable() : LawTable(ContactRules()) {}
  explicit LawTable(const ContactRules &);

  // All that a contact remembers: the tangential spring (N), then what the law has beside it.
  const std::vector<Remembered> &remembered() const { return names; }
  int memories() const { return int(names.size()) - 1; } // in addition to the tangential spring
  int constants() const { return counts.constants; }     // of a pair, in addition to PairConstants
  int books() const { return counts.books; }             // of a pair, in addition to those of Losses

  // `constants` of a pair of discs.
  void set_constants(const Coefficients &, const TwoGrains &, double *constants) const;
  // Stiffness and damping of the law's additions.
  Resistance added_resistance(const double *constants) const;
  Resistance added_resistance(const Coefficients &, const TwoGrains &) const;

  // Stored in the normal and the tangential spring of a contact, and in what is added (J).
  struct Energy {
    double normal, tangential, added;
  };
  Energy energy(const Material &, const double *constants, const double *remembered, double overlap) const;

  // For a list that will be replaced before its next forces: the loss of the dashpots' last forces in the step just
  // made (J). `dashpots`: the forces along n and t, then those of what is added; set to 0.
  double finish_books(const Contact<double> &, double dt, double *dashpots) const;

  ContactRules rules;

private:
  struct Counts {
    int constants, books;
  } counts{0, 0};
  std::vector<Remembered> names;
};

} // namespace cdem
