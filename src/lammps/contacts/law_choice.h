// SPDX-License-Identifier: GPL-2.0-or-later
// The contact law, as pair_style and pair_coeff give it and restart files keep it.
#pragma once

#include "contacts/pair_values.h"
#include "core/law_table.h"

#include "pointers.h"

#include <cstdio>
#include <string>

namespace LAMMPS_NS {

class LawChoice : protected Pointers {
public:
  explicit LawChoice(LAMMPS *);

  void read_style(int narg, char **arg);
  // The words after the two types of pair_coeff.
  cdem::Coefficients read_coefficients(int narg, char **arg);
  void forget_coefficients();

  cdem::LawTable table() const { return cdem::LawTable(rules); }

  // All of it, with the names of all parameters, so that a file of another version is never misread. `is_set`: whether
  // pair_coeff gave the coefficients of two types.
  std::string text(int **is_set) const;
  void write(FILE *, int **is_set) const;
  void read(FILE *, int **is_set); // all ranks together; the first one reads the file

  std::string instructions;
  PairValues::ByTypes coefficients; // by the types of two atoms

private:
  void read_addition(const std::string &name, int narg, char **arg, int &iarg, std::vector<double> &given);
  double read_parameter(const cdem::Parameter &, const char *word) const;
  void take_text(const std::string &, int **is_set);
  [[noreturn]] void refuse_file(const std::string &why) const;

  cdem::ContactRules rules;
};

} // namespace LAMMPS_NS
