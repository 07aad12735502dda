// SPDX-License-Identifier: GPL-2.0-or-later
#include "grains/fix_cdem_grains.h"

#include "host/find_fix.h"
#include "host/packed_state.h"

#include "atom.h"
#include "comm.h"
#include "fmt/format.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace LAMMPS_NS;

namespace {
constexpr int VERSION = 1; // of what restart files keep
constexpr double UNKNOWN = NAN;
} // namespace

FixCDEMGrains *FixCDEMGrains::find(LAMMPS *lmp) { return Shearbox::find_fix<FixCDEMGrains>(lmp); }

FixCDEMGrains *FixCDEMGrains::find_or_make(LAMMPS *lmp) {
  if (!find(lmp))
    lmp->modify->add_fix(std::string(ID) + " all cdem/grains");
  return find(lmp);
}

FixCDEMGrains::FixCDEMGrains(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  create_attribute = 1;
  restart_global = 1;
  restart_peratom = 1;
  FixCDEMGrains::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  for (int i = 0; i < atom->nlocal; i++)
    FixCDEMGrains::set_arrays(i);
}

FixCDEMGrains::~FixCDEMGrains() {
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
  memory->destroy(state);
}

void FixCDEMGrains::begin_moving(Fix *by) {
  mover = by;
  mover->array_atom = state;
}

bool FixCDEMGrains::knows_acceleration(int i) const {
  return kept.valid_step == update->ntimestep && !std::isnan(state[i][AX]);
}

void FixCDEMGrains::accelerations_are_of_this_step() { kept.valid_step = update->ntimestep; }

void FixCDEMGrains::set_inverses() {
  inverses.resize(atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++) {
    const double m = atom->rmass[i], r = atom->radius[i];
    inverses[i] = is_free(i) ? Inverse{1 / m, 1 / (m * r * r * inertias[atom->type[i]])} : Inverse{0, 0};
  }
}

cdem::StepRule FixCDEMGrains::step_rule() const {
  return {update->dt, 0.5 * update->dt * weight, gravity[0], gravity[1], drag};
}

double FixCDEMGrains::memory_usage() { return double(atom->nmax) * NCOLUMNS * sizeof(double); }

void FixCDEMGrains::grow_arrays(int nmax) {
  memory->grow(state, nmax, int(NCOLUMNS), "cdem/grains:state");
  if (mover)
    mover->array_atom = state;
}

void FixCDEMGrains::copy_arrays(int i, int j, int) { std::copy_n(state[i], int(NCOLUMNS), state[j]); }

void FixCDEMGrains::set_arrays(int i) {
  std::fill_n(state[i], int(NCOLUMNS), 0.0);
  state[i][ANGLE] = UNKNOWN;
  const bool running = update->whichflag != 0; // then no setup() follows, and a new atom starts with acceleration 0
  if (!running)
    state[i][AX] = UNKNOWN;
}

void FixCDEMGrains::write_data_section_size(int, int &rows, int &columns) {
  rows = atom->nlocal;
  columns = 2;
}

void FixCDEMGrains::write_data_section_pack(int, double **buf) {
  for (int i = 0; i < atom->nlocal; i++) {
    buf[i][0] = ubuf(atom->tag[i]).d;
    buf[i][1] = state[i][ANGLE];
  }
}

void FixCDEMGrains::write_data_section_keyword(int, FILE *file) {
  fmt::print(file, "\nAngles of grains, which read_data cannot read: use a restart file\n\n");
}

void FixCDEMGrains::write_data_section(int, FILE *file, int n, double **buf, int) {
  for (int i = 0; i < n; i++)
    fmt::print(file, "{} {:.17g}\n", tagint(ubuf(buf[i][0]).i), buf[i][1]);
}

int FixCDEMGrains::pack_exchange(int i, double *buf) {
  std::copy_n(state[i], int(NCOLUMNS), buf);
  return NCOLUMNS;
}

int FixCDEMGrains::unpack_exchange(int i, double *buf) {
  std::copy_n(buf, int(NCOLUMNS), state[i]);
  return NCOLUMNS;
}

void FixCDEMGrains::write_restart(FILE *fp) {
  if (comm->me == 0)
    Shearbox::write_state(fp, VERSION, kept);
}

void FixCDEMGrains::restart(char *buf) { kept = Shearbox::read_state<decltype(kept)>(lmp, style, VERSION, buf); }

int FixCDEMGrains::pack_restart(int i, double *buf) {
  buf[0] = NCOLUMNS + 1;
  std::copy_n(state[i], int(NCOLUMNS), buf + 1);
  return NCOLUMNS + 1;
}

void FixCDEMGrains::unpack_restart(int i, int nth) {
  std::copy_n(Shearbox::state_of_atom(lmp, style, atom->extra[i], nth, NCOLUMNS), int(NCOLUMNS), state[i]);
}

int FixCDEMGrains::size_restart(int) { return NCOLUMNS + 1; }

int FixCDEMGrains::maxsize_restart() { return NCOLUMNS + 1; }
