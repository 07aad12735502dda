// SPDX-License-Identifier: GPL-2.0-or-later
// LAMMPS with the styles of Shearbox and two fixes that another developer might add, under names like ours:
//
//   fix ID group cdem/counter      acts within every step: counts the steps (its scalar), in which it was called
//   fix ID group cdem/second       says that it integrates in time
//
// Neither says that it may be glided over (host/glides.h).
#include "comm.h"
#include "exceptions.h"
#include "fix.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"

#include <cstdlib>
#include <mpi.h>

using namespace LAMMPS_NS;

namespace {

class Counter : public Fix {
public:
  Counter(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) { scalar_flag = global_freq = extscalar = 1; }
  int setmask() override { return FixConst::POST_FORCE; }
  void post_force(int) override { calls++; }
  double compute_scalar() override { return calls; }

private:
  int calls = 0;
};

class Second : public Fix {
public:
  Second(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) { time_integrate = 1; }
  int setmask() override { return 0; }
};

template <class T> Fix *make(LAMMPS *lmp, int narg, char **arg) { return new T(lmp, narg, arg); }

} // namespace

int main(int argc, char **argv) {
  MPI_Init(&argc, &argv);
  int status = EXIT_SUCCESS;
  try {
    LAMMPS lmp(argc, argv, MPI_COMM_WORLD);
    (*lmp.modify->fix_map)["cdem/counter"] = make<Counter>;
    (*lmp.modify->fix_map)["cdem/second"] = make<Second>;
    lmp.input->file();
  } catch (const LAMMPSException &) {
    status = EXIT_FAILURE;
  }
  MPI_Finalize();
  return status;
}
