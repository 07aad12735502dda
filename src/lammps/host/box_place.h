// SPDX-License-Identifier: GPL-2.0-or-later
// A place beside the borders of the box, or of this rank's part of it. In a tilted box both are in shares of its sides.
#pragma once

#include "domain.h"

namespace Shearbox {

struct BoxPlace {
  double at[3];
  bool tilted;

  BoxPlace(LAMMPS_NS::Domain *domain, double x, double y) : at{x, y, 0}, tilted(domain->triclinic) {
    if (tilted)
      domain->x2lamda(at, at);
  }
};

struct Borders {
  const double *low, *high;

  static Borders of_box(const LAMMPS_NS::Domain *domain) {
    if (domain->triclinic)
      return {domain->boxlo_lamda, domain->boxhi_lamda};
    return {domain->boxlo, domain->boxhi};
  }
  static Borders of_rank(const LAMMPS_NS::Domain *domain) {
    if (domain->triclinic)
      return {domain->sublo_lamda, domain->subhi_lamda};
    return {domain->sublo, domain->subhi};
  }
};

} // namespace Shearbox
