// SPDX-License-Identifier: GPL-2.0-or-later
// fix cdem/trm: made by compute cdem/trm, not by the user. Sums over all steps, for each grain, how much it turned
// (rad) and how far it went (m). The sums migrate with the grain and are in restart files.
#pragma once

#include "core/disc_motion.h"
#include "host/glides.h"

#include "fix.h"

#include <vector>

namespace LAMMPS_NS {

class GrainRows;

class FixCDEMTRM : public Fix, public SumsSteps {
public:
  FixCDEMTRM(LAMMPS *, int, char **);
  ~FixCDEMTRM() override;

  cdem::Travel *travel() override { return sums.data(); } // those of walls have no meaning
  void add(const GrainRows &) override;

  int setmask() override;
  void post_integrate() override;

  double memory_usage() override;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;

private:
  std::vector<cdem::Travel> sums; // by atom
};

} // namespace LAMMPS_NS
