// SPDX-License-Identifier: GPL-2.0-or-later
// The columns of a compute's local array, chosen by their names.
#pragma once

#include "error.h"
#include "fmt/format.h"
#include "lammps.h"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace Shearbox {

template <class Row> struct Field {
  std::string name;
  std::function<double(const Row &)> value;
};

// The fields that arg names, in that order; all fields if it names none. `compute` begins the error message about an
// unknown name.
template <class Row>
std::vector<Field<Row>> choose_fields(LAMMPS_NS::LAMMPS *lmp, const std::string &compute, int narg, char **arg,
                                      const std::vector<Field<Row>> &all) {
  std::vector<Field<Row>> chosen;
  for (int k = 0; k < narg; k++) {
    const std::string name = arg[k];
    const auto found = std::find_if(all.begin(), all.end(), [&](const Field<Row> &f) { return f.name == name; });
    if (found == all.end()) {
      std::string allowed;
      for (const Field<Row> &f : all)
        allowed += " " + f.name;
      lmp->error->all(FLERR, "{}: unknown field {}; allowed:{}", compute, name, allowed);
    }
    chosen.push_back(*found);
  }
  return chosen.empty() ? all : chosen;
}

template <class Row> std::vector<std::string> names_of(const std::vector<Field<Row>> &fields) {
  std::vector<std::string> names;
  for (const Field<Row> &f : fields)
    names.push_back(f.name);
  return names;
}

} // namespace Shearbox
