// SPDX-License-Identifier: GPL-2.0-or-later
#include "grains/fix_cdem_audit.h"

#include "host/find_fix.h"
#include "host/packed_state.h"

#include "comm.h"

using namespace LAMMPS_NS;

namespace {
struct Saved {
  static constexpr int VERSION = 2;
  FixCDEMAudit::Books books;
  FixCDEMAudit::Opening opening;
  double open;
};
} // namespace

FixCDEMAudit *FixCDEMAudit::find(LAMMPS *lmp) { return Shearbox::find_fix<FixCDEMAudit>(lmp); }

FixCDEMAudit::FixCDEMAudit(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) { restart_global = 1; }

void FixCDEMAudit::setup(int) {
  if (opener)
    opener->open_books();
}

void FixCDEMAudit::take_gravity() {
  if (opener && open)
    opener->take_gravity();
}

FixCDEMAudit::Books FixCDEMAudit::all() const {
  const double mine[4] = {books.friction, books.dashpots, books.drag, books.walls};
  double sum[4];
  MPI_Allreduce(mine, sum, 4, MPI_DOUBLE, MPI_SUM, world);
  return {sum[0], sum[1], sum[2], sum[3]};
}

void FixCDEMAudit::write_restart(FILE *fp) {
  if (opener)
    opener->book_losses();
  const Saved saved{all(), opening, double(open)};
  if (comm->me == 0)
    Shearbox::write_state(fp, saved);
}

void FixCDEMAudit::restart(char *buf) {
  const auto saved = Shearbox::read_state<Saved>(lmp, style, buf);
  opening = saved.opening;
  open = saved.open != 0;
  books = comm->me == 0 ? saved.books : Books{}; // the sum over all ranks
}
