// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_cdem_trm.h"

#include "grain_rows.h"

#include "atom.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;

namespace {
constexpr int SIZE = 2;                // numbers per grain
constexpr int RESTART_SIZE = 1 + SIZE; // with their count in front, as LAMMPS wants it
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

// Here v and omega are those of the half step, with which the step was made: dx = dt v and d theta = dt omega, without
// differences of positions, which periodic boundaries and migration would break.
template <class Motion> void FixCDEMTRM::add_step(Motion motion) {
  const double dt = update->dt, *const radius = atom->radius;
  const int n = atom->nlocal, *const mask = atom->mask, bit = groupbit;
  Sums *const sum = sums.data();
  for (int i = 0; i < n; i++) {
    if (!(mask[i] & bit))
      continue;
    const auto [vx, vy, omega] = motion(i);
    sum[i].rolled += radius[i] * std::fabs(dt * omega);
    sum[i].path += dt * std::sqrt(vx * vx + vy * vy);
  }
}

namespace {
struct Velocity {
  double vx, vy, omega;
};
} // namespace

void FixCDEMTRM::post_integrate() {
  add_step([this](int i) { return Velocity{atom->v[i][0], atom->v[i][1], atom->omega[i][2]}; });
}

void FixCDEMTRM::add(const GrainRows &rows) {
  if (atom->nlocal == 0) // then there is no row 0
    return;
  const cdem::Disc<double> *const grain = &rows.of_grain(0);
  add_step([=](int i) { return Velocity{grain[i].vx_half, grain[i].vy_half, grain[i].omega_half}; });
}

double FixCDEMTRM::memory_usage() { return static_cast<double>(sums.capacity() * sizeof(Sums)); }

void FixCDEMTRM::grow_arrays(int nmax) { sums.resize(nmax, Sums{0, 0}); }

void FixCDEMTRM::copy_arrays(int i, int j, int) { sums[j] = sums[i]; }

void FixCDEMTRM::set_arrays(int i) { sums[i] = {0, 0}; }

int FixCDEMTRM::pack_exchange(int i, double *buf) {
  buf[0] = sums[i].rolled;
  buf[1] = sums[i].path;
  return SIZE;
}

int FixCDEMTRM::unpack_exchange(int i, double *buf) {
  sums[i] = {buf[0], buf[1]};
  return SIZE;
}

int FixCDEMTRM::pack_restart(int i, double *buf) {
  buf[0] = RESTART_SIZE;
  pack_exchange(i, buf + 1);
  return RESTART_SIZE;
}

// atom->extra holds the blocks of all fixes one after the other.
void FixCDEMTRM::unpack_restart(int i, int nth) {
  double *block = atom->extra[i];
  for (int skip = 0; skip < nth; skip++)
    block += static_cast<int>(*block);
  unpack_exchange(i, block + 1);
}

int FixCDEMTRM::size_restart(int) { return RESTART_SIZE; }

int FixCDEMTRM::maxsize_restart() { return RESTART_SIZE; }
