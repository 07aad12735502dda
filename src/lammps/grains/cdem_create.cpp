// SPDX-License-Identifier: GPL-2.0-or-later
#include "grains/cdem_create.h"

#include "grains/fix_cdem_shape.h"
#include "host/box_place.h"
#include "host/compat.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

using namespace LAMMPS_NS;

CDEMCreate::CDEMCreate(LAMMPS *lmp) : Command(lmp) {}

void CDEMCreate::command(int narg, char **arg) {
  if (!domain->box_exist)
    error->all(FLERR, "cdem/create: there is no simulation box yet");
  if (domain->dimension != 2)
    error->all(FLERR, "cdem/create: dimension is {}, must be 2", domain->dimension);
  if (!Shearbox::is_sphere(atom))
    error->all(FLERR, "cdem/create needs atom_style sphere");
  if (!atom->tag_enable)
    error->all(FLERR, "cdem/create needs atom ids");
  if (atom->nextra_store > 0)
    error->all(FLERR, "cdem/create: after read_restart a run must come first ('run 0'): fixes still have to take what "
                      "the restart file has of the atoms");

  Words words(lmp, "cdem/create", narg, arg);
  type = words.count("type");
  if (type > atom->ntypes)
    error->all(FLERR, "cdem/create: type {}: the box has {} atom types", type, atom->ntypes);
  const std::string shape = words.word("row or fill");
  if (shape != "row" && shape != "fill")
    error->all(FLERR, "cdem/create: {}: must be row or fill", shape);
  const auto [discs, density] = shape == "row" ? cdem::read_row(words) : fill(words);
  words.end();
  for (const Disc &disc : discs)
    check(disc);
  if (shape == "row")
    check_joints(discs);
  create(discs, density);
  if (comm->me == 0)
    utils::logmesg(lmp, "Created {} discs of type {}\n", discs.size(), type);
}

cdem::Creation CDEMCreate::fill(Words &words) const {
  try {
    return cdem::read_fill(words);
  } catch (const std::invalid_argument &bad) {
    error->all(FLERR, "cdem/create: {}", bad.what());
  }
  return {};
}

// Pieces of a smooth wall, one behind the other, act as one wall only where their ends meet: where they overlap, both
// push a disc, and a disc over a small gap leans on both ends.
void CDEMCreate::check_joints(const std::vector<Disc> &row) const {
  constexpr double TOLERANCE = 5e-7; // of a piece's length: as in contacts/line_feet.cpp, there of half of it
  const cdem::GrainShape &piece = FixCDEMShape::shape(lmp, type);
  if (row.size() < 2 || !piece.is_line())
    return;
  const cdem::WallLine axis = piece.axis(0.5 * row[0].diameter);
  const double dx = row[1].x - row[0].x, dy = row[1].y - row[0].y, length = 2 * axis.half;
  const double apart = std::fabs(dx * axis.ux + dy * axis.uy);
  if (std::fabs(dx * axis.uy - dy * axis.ux) > TOLERANCE * length)
    return; // side by side
  const std::string what =
      fmt::format("cdem/create: pieces of a smooth wall of diameter {:.9g} are {:.9g} long, and here {:.9g} apart",
                  row[0].diameter, length, apart);
  if (apart < (1 - TOLERANCE) * length)
    error->all(FLERR, "{}: they overlap, and each would push a disc there", what);
  if (apart > (1 + TOLERANCE) * length && apart < 2 * length && comm->me == 0)
    error->warning(FLERR, what + ": in the gaps the wall is not smooth");
}

void CDEMCreate::check(const Disc &disc) const {
  const Shearbox::BoxPlace centre(domain, disc.x, disc.y);
  const auto [low, high] = Shearbox::Borders::of_box(domain);
  for (int k = 0; k < 3; k++)
    if (!(centre.at[k] >= low[k] && centre.at[k] < high[k]))
      error->all(FLERR, "cdem/create: disc centre {} = {} is outside of the box, {} to {}{}", "xyz"[k], centre.at[k],
                 low[k], high[k], centre.tilted ? " in shares of its tilted sides" : "");
}

bool CDEMCreate::is_mine(const Disc &disc) const {
  const Shearbox::BoxPlace centre(domain, disc.x, disc.y);
  const auto [low, high] = Shearbox::Borders::of_rank(domain);
  for (int k = 0; k < 3; k++)
    if (!(centre.at[k] >= low[k] && centre.at[k] < high[k]))
      return false;
  return true;
}

// Every rank has the list of all discs. It makes those in its own part of the box, and numbers them by their places in
// the list.
void CDEMCreate::create(const std::vector<Disc> &discs, double density) {
  tagint largest = 0, offset;
  for (int i = 0; i < atom->nlocal; i++)
    largest = std::max(largest, atom->tag[i]);
  MPI_Allreduce(&largest, &offset, 1, MPI_LMP_TAGINT, MPI_MAX, world);

  const double area = FixCDEMShape::shape(lmp, type).area();
  atom->nghost = 0; // new atoms take the ghosts' place
  atom->avec->clear_bonus();
  const int before = atom->nlocal;
  for (std::size_t n = 0; n < discs.size(); n++) {
    const Disc &disc = discs[n];
    if (!is_mine(disc))
      continue;
    double centre[3] = {disc.x, disc.y, 0};
    atom->avec->create_atom(type, centre);
    const int i = atom->nlocal - 1;
    atom->tag[i] = offset + 1 + tagint(n);
    atom->radius[i] = 0.5 * disc.diameter;
    atom->rmass[i] = density * area * atom->radius[i] * atom->radius[i];
  }
  atom->data_fix_compute_variable(before, atom->nlocal);

  const bigint expected = atom->natoms + bigint(discs.size()), mine = atom->nlocal;
  MPI_Allreduce(&mine, &atom->natoms, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (atom->natoms != expected)
    error->all(FLERR, "cdem/create: there are {} atoms now, should be {}: some lie in the part of no rank",
               atom->natoms, expected);
  atom->tag_check();
  if (atom->map_style != Atom::MAP_NONE) {
    atom->map_init();
    atom->map_set();
  }
}
