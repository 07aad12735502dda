// SPDX-License-Identifier: GPL-2.0-or-later
#include "motion/rescue.h"

#include "contacts/fix_cdem_history.h"
#include "grains/fix_cdem_grains.h"

#include "atom.h"
#include "atom_vec.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "modify.h"
#include "update.h"
#include "write_restart.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

using namespace LAMMPS_NS;

void Rescue::take() {
  std::swap(copies[0], copies[1]);
  Copy &copy = copies[1];
  copy.step = update->ntimestep;
  std::copy_n(domain->boxlo, 3, copy.low);
  std::copy_n(domain->boxhi, 3, copy.high);
  copy.tilt = domain->xy;
  pack_atoms(copy);
  ask_fixes(copy);
}

void Rescue::pack_atoms(Copy &copy) {
  FixCDEMHistory::find(lmp)->copy_from_list();
  FixCDEMGrains::find(lmp)->copy_scene();
  constexpr int EXTRA = 1024; // as much as LAMMPS's own buffers have in reserve
  int largest = atom->avec->maxexchange + EXTRA;
  for (int k = 0; k < modify->nfix; k++)
    largest += modify->fix[k]->maxexchange;
  copy.natoms = atom->nlocal;
  std::size_t used = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (copy.atoms.size() < used + largest)
      copy.atoms.resize(2 * used + largest);
    used += atom->avec->pack_exchange(i, &copy.atoms[used]);
  }
  copy.atoms.resize(used);
  copy.atoms.shrink_to_fit();
}

void Rescue::unpack_atoms(Copy &copy) {
  FixCDEMHistory::find(lmp)->take_from_list();
  atom->nlocal = atom->nghost = 0;
  double *next = copy.atoms.data();
  for (int i = 0; i < copy.natoms; i++)
    next += atom->avec->unpack_exchange(next);
  const bigint mine = atom->nlocal; // grains may have come or gone since
  MPI_Allreduce(&mine, &atom->natoms, 1, MPI_LMP_BIGINT, MPI_SUM, world);
}

void Rescue::ask_fixes(Copy &copy) {
  copy.fixes.clear();
  for (int k = 0; k < modify->nfix; k++) {
    if (!modify->fix[k]->restart_global)
      continue;
    char *text = nullptr;
    std::size_t size = 0;
    FILE *const memory = open_memstream(&text, &size);
    if (!memory)
      error->one(FLERR, "Fix cdem/integrate: no memory to keep the state of fix {}", modify->fix[k]->id);
    modify->fix[k]->write_restart(memory);
    fclose(memory);
    copy.fixes[modify->fix[k]->id].assign(text, size);
    free(text);
  }
}

// The block of a fix begins with its length, which restart() does not get.
void Rescue::tell_fixes(const Copy &copy) {
  for (int k = 0; k < modify->nfix; k++) {
    Fix *const fix = modify->fix[k];
    std::string block;
    if (const auto found = copy.fixes.find(fix->id); found != copy.fixes.end())
      block = found->second;
    int size = int(block.size());
    MPI_Bcast(&size, 1, MPI_INT, 0, world);
    block.resize(size);
    MPI_Bcast(block.data(), size, MPI_CHAR, 0, world);
    if (size > int(sizeof(int)))
      fix->restart(block.data() + sizeof(int));
  }
}

bigint Rescue::write(const std::string &file) {
  Copy &copy = copies[0].step >= 0 ? copies[0] : copies[1];
  if (copy.step < 0)
    return -1;
  update->ntimestep = copy.step; // some fixes refuse a state of another step
  restore_box(copy);
  unpack_atoms(copy);
  wrap_atoms();
  tell_fixes(copy);
  std::string name = file, without_setup = "noinit";
  char *words[] = {name.data(), without_setup.data()};
  WriteRestart(lmp).command(2, words);
  return copy.step;
}

// It may have changed since, and atoms must be inside of it to be read again.
void Rescue::restore_box(const Copy &copy) {
  std::copy_n(copy.low, 3, domain->boxlo);
  std::copy_n(copy.high, 3, domain->boxhi);
  domain->xy = copy.tilt;
  domain->set_initial_box(0);
  domain->set_global_box();
  domain->set_local_box();
  if (domain->triclinic)
    domain->set_lamda_box();
}

void Rescue::wrap_atoms() {
  if (domain->triclinic)
    domain->x2lamda(atom->nlocal);
  domain->pbc();
  domain->reset_box(); // a shrink-wrapped one: around the atoms
  if (domain->triclinic)
    domain->lamda2x(atom->nlocal);
}

double Rescue::bytes() const {
  return double(copies[0].atoms.capacity() + copies[1].atoms.capacity()) * sizeof(double);
}
