// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/onlookers.h"

#include "compute.h"
#include "lammps.h"
#include "modify.h"

#include <algorithm>
#include <string_view>

using namespace LAMMPS_NS;

namespace {
constexpr std::string_view DO_NOT[] = {"temp",       "pressure",   "pe",         "ke",      "cdem/energy",
                                       "cdem/force", "cdem/discs", "cdem/limit", "cdem/trm"};
}

bool LAMMPS_NS::contacts_are_looked_at(LAMMPS *lmp) {
  const Modify &m = *lmp->modify;
  return std::any_of(m.compute, m.compute + m.ncompute, [](const Compute *compute) {
    return std::find(std::begin(DO_NOT), std::end(DO_NOT), compute->style) == std::end(DO_NOT);
  });
}
