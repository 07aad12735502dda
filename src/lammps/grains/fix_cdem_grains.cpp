// SPDX-License-Identifier: GPL-2.0-or-later
#include "grains/fix_cdem_grains.h"

#include "host/compat.h"
#include "host/find_fix.h"
#include "host/fingerprint.h"
#include "host/packed_state.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fmt/format.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <string>

using namespace LAMMPS_NS;

namespace {
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

void FixCDEMGrains::set_shapes(bool yes) {
  kept.shapes = yes;
  wd_section = yes;
}

// If no other fix acts on them, LAMMPS has them still when they are to be kept.
void FixCDEMGrains::forces_are_there() {
  if (Shearbox::fixes_after_forces(modify))
    keep_forces();
}

void FixCDEMGrains::keep_forces() {
  for (int i = 0; i < atom->nlocal; i++) {
    state[i][FX] = atom->f[i][0];
    state[i][FY] = atom->f[i][1];
    state[i][TORQUE] = atom->torque[i][2];
  }
}

void FixCDEMGrains::restore_forces() const {
  for (int i = 0; i < atom->nlocal; i++) {
    atom->f[i][0] = state[i][FX];
    atom->f[i][1] = state[i][FY];
    atom->torque[i][2] = state[i][TORQUE];
  }
}

// Between runs nothing is kept: the scene may have changed since the forces were computed.
void FixCDEMGrains::keep_scene() {
  copy_scene();
  scene_is_new = false;
}

void FixCDEMGrains::copy_scene() {
  if (!scene_is_new)
    return;
  if (!Shearbox::fixes_after_forces(modify))
    keep_forces();
  for (int i = 0; i < atom->nlocal; i++) {
    state[i][X] = atom->x[i][0];
    state[i][Y] = atom->x[i][1];
  }
  kept.grains = fingerprint_of_grains();
  kept.rules = fingerprint_of_rules();
}

bool FixCDEMGrains::scene_is_as_kept() {
  const double most = rounding();
  int mine = 1, all;
  for (int i = 0; i < atom->nlocal; i++) {
    const Shift shift = shift_from_kept(i);
    mine &= std::fabs(shift.x) <= most && std::fabs(shift.y) <= most; // not if it is NaN
  }
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MIN, world);
  if (!all || kept.grains != fingerprint_of_grains())
    return false;
  for (int i = 0; i < atom->nlocal; i++)
    if (!shift_from_kept(i).periods) {
      atom->x[i][0] = state[i][X];
      atom->x[i][1] = state[i][Y];
    }
  return kept.rules == fingerprint_of_rules();
}

bool FixCDEMGrains::moved_against_each_other() const {
  const auto [x0, y0] = shift_of_first();
  double mine = 0, most;
  for (int i = 0; i < atom->nlocal; i++) {
    const Shift other = less_periods(atom->x[i][0] - state[i][X] - x0, atom->x[i][1] - state[i][Y] - y0);
    if (is_free(i) && !std::isnan(other.x)) // NaN: it has come since
      mine = std::max({mine, std::fabs(other.x), std::fabs(other.y)});
  }
  MPI_Allreduce(&mine, &most, 1, MPI_DOUBLE, MPI_MAX, world);
  return most > 2 * rounding();
}

// How far one grain has moved, the same for all ranks: the first of the lowest rank that has any (m).
std::array<double, 2> FixCDEMGrains::shift_of_first() const {
  std::array<double, 2> shift{0, 0};
  int mine = comm->nprocs, first;
  for (int i = 0; i < atom->nlocal && mine == comm->nprocs; i++)
    if (is_free(i) && !std::isnan(state[i][X])) {
      shift = {atom->x[i][0] - state[i][X], atom->x[i][1] - state[i][Y]};
      mine = comm->me;
    }
  MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, world);
  if (first < comm->nprocs)
    MPI_Bcast(shift.data(), 2, MPI_DOUBLE, first, world);
  return shift;
}

// Of their fingerprints, on all ranks: the same in any order.
template <class OfAtom> std::uint64_t FixCDEMGrains::sum_over_atoms(OfAtom of_atom) const {
  std::uint64_t mine = 0, all;
  for (int i = 0; i < atom->nlocal; i++)
    mine += of_atom(i).value();
  MPI_Allreduce(&mine, &all, 1, MPI_UINT64_T, MPI_SUM, world);
  return all;
}

std::uint64_t FixCDEMGrains::members() const {
  if (!mover) // fix cdem/integrate is gone: there are no grains
    return 0;
  return sum_over_atoms([this](int i) {
    Shearbox::Fingerprint of_list;
    return of_list.add(atom->tag[i]).add(atom->type[i]).add(is_free(i)).add(atom->radius[i]).add(atom->rmass[i]);
  });
}

void FixCDEMGrains::post_run() {
  keep_scene();
  members_of_run = members();
}

FixCDEMGrains::Periods FixCDEMGrains::periods() const {
  const bool y = domain->periodicity[1];
  return {domain->periodicity[0] ? domain->xprd : 0, y ? domain->yprd : 0, y ? domain->xy : 0};
}

FixCDEMGrains::Shift FixCDEMGrains::shift_from_kept(int i) const {
  return less_periods(atom->x[i][0] - state[i][X], atom->x[i][1] - state[i][Y]);
}

FixCDEMGrains::Shift FixCDEMGrains::less_periods(double dx, double dy) const {
  const Periods period = periods();
  Shift shift{dx, dy, false};
  const double ny = period.y > 0 ? std::nearbyint(shift.y / period.y) : 0;
  shift.y -= ny * period.y;
  shift.x -= ny * period.tilt;
  const double nx = period.x > 0 ? std::nearbyint(shift.x / period.x) : 0;
  shift.x -= nx * period.x;
  shift.periods = nx != 0 || ny != 0;
  return shift;
}

// Of a coordinate that LAMMPS has shifted by a period, or scaled to the box and back (m): a few operations, each exact
// to half of the last bit.
double FixCDEMGrains::rounding() const {
  double largest = 0;
  for (int k = 0; k < 2; k++)
    largest = std::max({largest, std::fabs(domain->boxlo[k]), std::fabs(domain->boxhi[k]), domain->prd[k]});
  return 8 * DBL_EPSILON * largest;
}

// The place that was kept, since it says which atom it is.
std::uint64_t FixCDEMGrains::fingerprint_of_grains() const {
  return sum_over_atoms([this](int i) {
    Shearbox::Fingerprint grain;
    for (const double number : {state[i][X], state[i][Y], state[i][ANGLE], atom->v[i][0], atom->v[i][1],
                                atom->omega[i][2], atom->radius[i], atom->rmass[i]})
      grain.add(number);
    return grain.add(atom->type[i]).add(is_free(i));
  });
}

std::uint64_t FixCDEMGrains::fingerprint_of_rules() const {
  const Periods period = periods();
  return Shearbox::Fingerprint().add(rules).add(period.x).add(period.y).add(period.tilt).value();
}

cdem::StepRule FixCDEMGrains::step_rule() const {
  return {update->dt, 0.5 * update->dt * weight, gravity[0], gravity[1], drag, damping};
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
  state[i][ANGLE] = state[i][X] = state[i][Y] = UNKNOWN;
}

// LAMMPS's data files have no angles of grains, and a file without them would be read with all angles 0: this one is
// refused by read_data.
void FixCDEMGrains::write_data_section_size(int, int &rows, int &columns) {
  if (comm->me == 0)
    error->warning(FLERR,
                   "A data file of grains of several discs, or of smooth walls, cannot be read: use write_restart");
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

// LAMMPS calls this before it packs the grains.
void FixCDEMGrains::write_restart(FILE *fp) {
  copy_scene();
  if (comm->me == 0)
    Shearbox::write_state(fp, kept);
}

void FixCDEMGrains::restart(char *buf) {
  kept = Shearbox::read_state<Kept>(lmp, style, buf);
  scene_is_new = false;
}

int FixCDEMGrains::pack_restart(int i, double *buf) {
  std::copy_n(state[i], int(NCOLUMNS), Shearbox::begin_atom(buf, atom->tag[i], NCOLUMNS));
  return size_restart(i);
}

void FixCDEMGrains::unpack_restart(int i, int nth) {
  const auto size = [](const double *) { return int(NCOLUMNS); };
  std::copy_n(Shearbox::state_of_atom(lmp, style, i, nth, size), int(NCOLUMNS), state[i]);
}

int FixCDEMGrains::size_restart(int) { return Shearbox::HEAD_OF_ATOM + NCOLUMNS; }

int FixCDEMGrains::maxsize_restart() { return Shearbox::HEAD_OF_ATOM + NCOLUMNS; }
