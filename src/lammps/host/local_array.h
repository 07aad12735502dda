// SPDX-License-Identifier: GPL-2.0-or-later
// The rows that a compute with local output passes to LAMMPS: always an array of rows, also with one column or no row.
#pragma once

#include <cstddef>
#include <vector>

namespace Shearbox {

class LocalArray {
public:
  void clear() { values.clear(); }
  void add(double value) { values.push_back(value); }

  // Pointers to the rows, valid until the next change.
  double **rows(int columns) {
    first_of_row.clear();
    for (std::size_t k = 0; k < values.size(); k += columns)
      first_of_row.push_back(&values[k]);
    return first_of_row.data();
  }

  int size() const { return static_cast<int>(first_of_row.size()); }

  double memory_usage() const {
    return static_cast<double>(values.capacity() * sizeof(double) + first_of_row.capacity() * sizeof(double *));
  }

private:
  std::vector<double> values;
  std::vector<double *> first_of_row;
};

} // namespace Shearbox
