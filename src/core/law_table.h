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

// Names of all numbers that contacts remember, whatever the law.
std::vector<std::string> all_remembered();

// What pair_coeff gives: first of all the contact law's own parameters, without a name, then those of each addition.
struct ParameterGroup {
  std::string name;
  std::vector<Parameter> parameters;
};
const std::vector<ParameterGroup> &parameter_groups();

// Of two atom types: the parameters in the order of the groups, 0 of additions that were not given.
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
  int memories() const { return int(names.size()) - 1; } // beside the tangential spring
  int constants() const { return counts.constants; }     // of a pair, beside PairConstants
  int books() const { return counts.books; }             // of a pair, beside those of Losses

  // `constants` of a pair of discs.
  void set_constants(const Coefficients &, const TwoGrains &, double *constants) const;
  // How what is added to springs and dashpots resists.
  Resistance added_resistance(const double *constants) const;
  Resistance added_resistance(const Coefficients &, const TwoGrains &) const;

  // Stored in the normal and the tangential spring of a contact, and in what is added (J).
  struct Energy {
    double normal, tangential, added;
  };
  Energy energy(const Material &, const double *constants, const double *remembered, double overlap) const;

  // For a list of pairs that will not know of the next forces: books the part of the dashpots' last forces that belongs
  // to the step just made (J). `dashpots`: the forces along n and t, then those of what is added; set to 0.
  double finish_books(const Contact<double> &, double dt, double *dashpots) const;

  ContactRules rules;

private:
  struct Counts {
    int constants, books;
  } counts{0, 0};
  std::vector<Remembered> names;
};

} // namespace cdem
