// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/fix_cdem_trm.h"

#include "grains/grain_rows.h"
#include "host/packed_state.h"

#include "atom.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {
constexpr int SIZE = 2; // numbers per grain
} // namespace

FixCDEMTRM::FixCDEMTRM(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  create_attribute = 1;
  restart_peratom = 1;
  maxexchange = SIZE;
  FixCDEMTRM::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
}

FixCDEMTRM::~FixCDEMTRM() {
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
}

int FixCDEMTRM::setmask() { return FixConst::POST_INTEGRATE; }

// At this point v and omega are those of the half step, with which the step was made: dx = dt v and d theta = dt omega.
// Differences of positions would be wrong across periodic boundaries and after migration.
void FixCDEMTRM::post_integrate() {
  for (int i = 0; i < atom->nlocal; i++)
    sums[i].add(atom->v[i][0], atom->v[i][1], atom->omega[i][2], update->dt);
}

void FixCDEMTRM::add(const GrainRows &rows) {
  for (int i = 0; i < atom->nlocal; i++) {
    const cdem::Disc<double> &grain = rows.of_grain(i);
    sums[i].add(grain.vx_half, grain.vy_half, grain.omega_half, update->dt);
  }
}

double FixCDEMTRM::memory_usage() { return static_cast<double>(sums.capacity() * sizeof(cdem::Travel)); }

void FixCDEMTRM::grow_arrays(int nmax) { sums.resize(nmax); }

void FixCDEMTRM::copy_arrays(int i, int j, int) { sums[j] = sums[i]; }

void FixCDEMTRM::set_arrays(int i) { sums[i] = {}; }

int FixCDEMTRM::pack_exchange(int i, double *buf) {
  buf[0] = sums[i].path;
  buf[1] = sums[i].turned;
  return SIZE;
}

int FixCDEMTRM::unpack_exchange(int i, double *buf) {
  sums[i] = {buf[0], buf[1]};
  return SIZE;
}

int FixCDEMTRM::pack_restart(int i, double *buf) {
  pack_exchange(i, Shearbox::begin_atom(buf, atom->tag[i], SIZE));
  return size_restart(i);
}

void FixCDEMTRM::unpack_restart(int i, int nth) {
  const double *const numbers = Shearbox::state_of_atom(lmp, style, i, nth, [](const double *) { return SIZE; });
  sums[i] = {numbers[0], numbers[1]};
}

int FixCDEMTRM::size_restart(int) { return Shearbox::HEAD_OF_ATOM + SIZE; }

int FixCDEMTRM::maxsize_restart() { return Shearbox::HEAD_OF_ATOM + SIZE; }
