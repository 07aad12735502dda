// SPDX-License-Identifier: GPL-2.0-or-later
#include "liggghts/create.h"

#include "core/create_words.h"

#include "atom.h"
#include "atom_vec.h"
#include "domain.h"

#include <cmath>
#include <stdexcept>

using namespace LAMMPS_NS;

namespace Liggghts {

namespace {

using Discs = std::vector<cdem::PlacedDisc>;

cdem::Creation fill(LAMMPS *lmp, Words &words) {
  try {
    return cdem::read_fill(words);
  } catch (const std::invalid_argument &bad) {
    stop(lmp, "cdem/create: ", bad.what());
  }
}

bool is_mine(const Domain &domain, const double *centre) {
  for (int k = 0; k < 3; k++)
    if (!(centre[k] >= domain.sublo[k] && centre[k] < domain.subhi[k]))
      return false;
  return true;
}

// Every rank has the list of all discs. It makes those in its own part of the box, and numbers them by their places in
// the list.
void make(LAMMPS *lmp, int type, const Discs &discs, double density) {
  Atom &atom = *lmp->atom;
  int largest = 0;
  for (int i = 0; i < atom.nlocal; i++)
    largest = std::max(largest, atom.tag[i]);
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_INT, MPI_MAX, lmp->world);

  atom.nghost = 0; // new atoms take the ghosts' place
  for (std::size_t n = 0; n < discs.size(); n++) {
    double centre[3] = {discs[n].x, discs[n].y, 0};
    if (!is_mine(*lmp->domain, centre))
      continue;
    atom.avec->create_atom(type, centre);
    const int i = atom.nlocal - 1;
    const double r = 0.5 * discs[n].diameter;
    atom.tag[i] = largest + 1 + int(n);
    atom.radius[i] = r;
    atom.density[i] = density;
    atom.rmass[i] = density * M_PI * r * r;
    for (int fix = 0; fix < lmp->modify->nfix; fix++)
      if (lmp->modify->fix[fix]->create_attribute)
        lmp->modify->fix[fix]->set_arrays(i);
  }
  const bigint expected = atom.natoms + bigint(discs.size()), mine = atom.nlocal;
  MPI_Allreduce(&mine, &atom.natoms, 1, MPI_LMP_BIGINT, MPI_SUM, lmp->world);
  if (atom.natoms != expected)
    stop(lmp, "cdem/create: there are ", atom.natoms, " atoms now, should be ", expected, ": some lie outside the box");
  if (atom.map_style) {
    atom.map_init();
    atom.map_set();
  }
}

} // namespace

void create(LAMMPS *lmp, int narg, char **arg) {
  if (!lmp->domain->box_exist || lmp->domain->dimension != 2)
    stop(lmp, "cdem/create needs a box and dimension 2");
  Words words(lmp, "cdem/create", narg, arg, 0);
  const int type = words.count("type");
  if (type > lmp->atom->ntypes)
    stop(lmp, "cdem/create: type ", type, ": the box has ", lmp->atom->ntypes, " atom types");
  const std::string how = words.word("row or fill");
  if (how != "row" && how != "fill")
    stop(lmp, "cdem/create: ", how, ": must be row or fill");
  const auto [discs, density] = how == "row" ? cdem::read_row(words) : fill(lmp, words);
  if (!words.done())
    stop(lmp, "cdem/create: unknown word ", words.word("word"));
  make(lmp, type, discs, density);
  std::ostringstream line;
  line << "Created " << discs.size() << " discs of type " << type;
  tell(lmp, line.str());
}

} // namespace Liggghts
