// SPDX-License-Identifier: GPL-2.0-or-later
#include "grains/cdem_create.h"

#include "core/fill.h"
#include "grains/fix_cdem_shape.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "utils.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

CDEMCreate::CDEMCreate(LAMMPS *lmp) : Command(lmp) {}

// The words of the command, read one after the other; each reader names what it misses.
class CDEMCreate::Arguments {
public:
  Arguments(LAMMPS *lmp, int narg, char **arg) : lmp(lmp), words(arg, arg + narg) {}

  std::string word(const char *what) {
    if (next == words.size())
      lmp->error->all(FLERR, "cdem/create: {} is missing", what);
    return words[next++];
  }

  void keyword(const char *name) {
    const std::string w = word(name);
    if (w != name)
      lmp->error->all(FLERR, "cdem/create: {} where {} is expected", w, name);
  }

  double number(const char *what) { return utils::numeric(FLERR, word(what).c_str(), false, lmp); }

  double positive(const char *what) {
    const double x = number(what);
    if (!(x > 0 && std::isfinite(x)))
      lmp->error->all(FLERR, "cdem/create: {} {}: must be positive", what, x);
    return x;
  }

  int count(const char *what) {
    const int n = utils::inumeric(FLERR, word(what).c_str(), false, lmp);
    if (n < 1)
      lmp->error->all(FLERR, "cdem/create: {} {}: must be 1 or more", what, n);
    return n;
  }

  void end() const {
    if (next < words.size())
      lmp->error->all(FLERR, "cdem/create: unexpected {}", words[next]);
  }

  LAMMPS *const lmp;

private:
  const std::vector<std::string> words;
  std::size_t next = 0;
};

void CDEMCreate::command(int narg, char **arg) {
  if (!domain->box_exist)
    error->all(FLERR, "cdem/create: there is no simulation box yet");
  if (domain->dimension != 2)
    error->all(FLERR, "cdem/create: dimension is {}, must be 2", domain->dimension);
  if (!atom->sphere_flag)
    error->all(FLERR, "cdem/create needs atom_style sphere");
  if (!atom->tag_enable)
    error->all(FLERR, "cdem/create needs atom ids");

  Arguments arguments(lmp, narg, arg);
  type = arguments.count("type");
  if (type > atom->ntypes)
    error->all(FLERR, "cdem/create: type {}: the box has {} atom types", type, atom->ntypes);
  const std::string shape = arguments.word("row or fill");
  if (shape != "row" && shape != "fill")
    error->all(FLERR, "cdem/create: {}: must be row or fill", shape);
  const std::vector<Disc> discs = shape == "row" ? row(arguments) : fill(arguments);
  arguments.end();
  for (const Disc &disc : discs)
    check(disc);
  create(discs);
  if (comm->me == 0)
    utils::logmesg(lmp, "Created {} discs of type {}\n", discs.size(), type);
}

std::vector<CDEMCreate::Disc> CDEMCreate::row(Arguments &arguments) {
  const double x1 = arguments.number("X1"), y1 = arguments.number("Y1");
  const double x2 = arguments.number("X2"), y2 = arguments.number("Y2");
  const int n = arguments.count("number of discs");
  arguments.keyword("diameter");
  const double diameter = arguments.positive("diameter");
  read_density(arguments);
  std::vector<Disc> discs;
  for (int i = 0; i < n; i++) {
    const double share = n > 1 ? double(i) / (n - 1) : 0;
    discs.push_back({x1 + share * (x2 - x1), y1 + share * (y2 - y1), diameter});
  }
  return discs;
}

std::vector<CDEMCreate::Disc> CDEMCreate::fill(Arguments &arguments) {
  const int n = arguments.count("number of grains");
  arguments.keyword("region");
  const double xlo = arguments.number("XLO"), xhi = arguments.number("XHI");
  const double ylo = arguments.number("YLO"), yhi = arguments.number("YHI");
  if (!(xlo < xhi && ylo < yhi))
    error->all(FLERR, "cdem/create: region {} {} {} {}: must be XLO < XHI, YLO < YHI", xlo, xhi, ylo, yhi);
  arguments.keyword("diameter");
  const double smallest = arguments.positive("DMIN"), largest = arguments.positive("DMAX");
  if (smallest > largest)
    error->all(FLERR, "cdem/create: diameter {} {}: must be DMIN <= DMAX", smallest, largest);
  if (largest > xhi - xlo)
    error->all(FLERR, "cdem/create: grains of diameter {} do not fit in the width {} of the region", largest,
               xhi - xlo);
  arguments.keyword("power");
  const double power = arguments.number("power");
  if (!std::isfinite(power))
    error->all(FLERR, "cdem/create: power {}: must be a number", power);
  read_density(arguments);
  arguments.keyword("seed");
  cdem::Random random(arguments.count("seed"));

  const auto diameters = cdem::power_law_diameters(n, smallest, largest, power, random);
  double needed;
  const auto places = cdem::rows_of_discs(diameters, xhi - xlo, yhi - ylo, random, needed);
  if (places.empty())
    error->all(FLERR,
               "cdem/create: {} grains of diameter {} to {} fill a height of {} in the width {}; the region has {}", n,
               smallest, largest, needed, xhi - xlo, yhi - ylo);
  std::vector<Disc> discs;
  for (int i = 0; i < n; i++)
    discs.push_back({xlo + places[i].x, ylo + places[i].y, diameters[i]});
  return discs;
}

void CDEMCreate::read_density(Arguments &arguments) {
  arguments.keyword("density");
  density = arguments.positive("density");
}

void CDEMCreate::check(const Disc &disc) const {
  const double centre[3] = {disc.x, disc.y, 0};
  for (int k = 0; k < 3; k++)
    if (!(centre[k] >= domain->boxlo[k] && centre[k] < domain->boxhi[k]))
      error->all(FLERR, "cdem/create: disc centre {} = {} is outside of the box, {} to {}", "xyz"[k], centre[k],
                 domain -> boxlo[k], domain -> boxhi[k]);
}

bool CDEMCreate::is_mine(const Disc &disc) const {
  return disc.x >= domain->sublo[0] && disc.x < domain->subhi[0] && disc.y >= domain->sublo[1] &&
         disc.y < domain->subhi[1] && 0 >= domain->sublo[2] && 0 < domain->subhi[2];
}

// Every rank knows all discs, makes its own, and numbers them as if it had made all.
void CDEMCreate::create(const std::vector<Disc> &discs) {
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
    error->all(FLERR, "cdem/create: there are {} atoms now, should be {}: some have no rank", atom->natoms, expected);
  atom->tag_check();
  if (atom->map_style != Atom::MAP_NONE) {
    atom->map_init();
    atom->map_set();
  }
}
