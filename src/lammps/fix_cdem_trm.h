// SPDX-License-Identifier: GPL-2.0-or-later
// fix cdem/trm: made by compute cdem/trm, not by the user. Sums every step, for each grain of the group, how far it
// rolled and how far it went; the sums travel with the grain and are in restart files.
#pragma once

#include "fix.h"

#include <vector>

namespace LAMMPS_NS {

class GrainRows;

class FixCDEMTRM : public Fix {
public:
  struct Sums {
    double rolled; // sum of r |d theta|, m
    double path;   // sum of sqrt(dx^2 + dy^2), m
  };

  FixCDEMTRM(LAMMPS *, int, char **);
  ~FixCDEMTRM() override;

  const Sums &operator[](int i) const { return sums[i]; }

  void add(const GrainRows &); // a step made on rows

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
  template <class Motion> void add_step(Motion);

  std::vector<Sums> sums; // per atom
};

} // namespace LAMMPS_NS
