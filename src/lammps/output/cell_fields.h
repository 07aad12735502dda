// SPDX-License-Identifier: GPL-2.0-or-later
// Means of the grains of a group and of their contacts over the cells of a rectangle: what computes cdem/average and
// cdem/grid have in common. The page of cdem/average says what the fields are; core/field_sums.h has the formulas.
#pragma once

#include "contacts/contact_report.h"
#include "core/field_sums.h"
#include "host/deck_words.h"
#include "output/named_fields.h"
#include "output/within.h"

#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixCDEMGrains;
class PairCDEM;

class CellFields : protected Pointers {
public:
  using Field = Shearbox::Field<cdem::CellMeans>;

  // Reads the last words of a compute, `[within ...] [field ...]`. The fields are those in `before` and those of
  // cdem/average.
  CellFields(LAMMPS *, int group_bit, Shearbox::DeckWords words, char **arg, const std::vector<Field> &before = {});

  void init();
  int columns() const { return int(fields.size()); }
  std::vector<std::string> names() const { return Shearbox::names_of(fields); }
  // The fields of each cell, cells along x first; the same bits on all ranks, however many there are.
  std::vector<std::vector<double>> rows(int nx, int ny);

private:
  using Contact = ContactReport::Contact;
  bool counts(int i) const;
  cdem::FieldSums::Largest largest(const std::vector<Contact> &) const;
  template <class Visit> void for_each_image(const cdem::Rectangle &in, const cdem::Rectangle &part, Visit) const;
  void add_grains(cdem::FieldSums &, const cdem::Rectangle &in, const std::vector<Contact> &) const;
  void add_branches(cdem::FieldSums &, const cdem::Rectangle &in, const std::vector<Contact> &) const;

  const std::string who;
  const int group_bit;
  Within within;
  std::vector<Field> fields;
  const PairCDEM *pair = nullptr;
  const FixCDEMGrains *grains = nullptr;
};

} // namespace LAMMPS_NS
