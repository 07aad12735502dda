// SPDX-License-Identifier: GPL-2.0-or-later
#include "grains/fix_cdem_shape.h"

#include "grains/fix_cdem_grains.h"
#include "host/find_fix.h"

#include "atom.h"
#include "error.h"
#include "fmt/format.h"
#include "utils.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

using namespace LAMMPS_NS;
using Member = cdem::GrainShape::Member;

FixCDEMShape *FixCDEMShape::find(LAMMPS *lmp) { return Shearbox::find_fix<FixCDEMShape>(lmp); }

const cdem::GrainShape &FixCDEMShape::shape(LAMMPS *lmp, int type) {
  static const cdem::GrainShape disc = cdem::GrainShape::single();
  const FixCDEMShape *const fix = find(lmp);
  return fix ? *fix->shapes[type] : disc;
}

FixCDEMShape::FixCDEMShape(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg), shapes(atom->ntypes + 1) {
  if (find(lmp))
    error->all(FLERR, "Fix cdem/shape {}: there is one already, {}", id, find(lmp)->id);
  Shearbox::DeckWords words(lmp, "Fix cdem/shape", narg, arg, 3);
  while (!words.done()) {
    const std::string key = words.word("keyword");
    if (key == "folder") {
      folder = words.word("folder: its name");
    } else if (key == "type") {
      read_template(words);
    } else if (key == "density") {
      density = words.positive("density");
    } else if (key == "orient") {
      seed = words.count("orient");
    } else {
      error->all(FLERR, "Fix cdem/shape: unknown keyword {}; allowed: folder, type, density, orient", key);
    }
  }
  for (int type = 1; type <= atom->ntypes; type++)
    if (!shapes[type])
      error->all(FLERR, "Fix cdem/shape: atom type {} has no template", type);
  create_attribute = 1;
  array_flag = 1;
  size_array_rows = atom->ntypes;
  size_array_cols = 3;
  global_freq = 1;
  extarray = 0;
  atom->add_callback(Atom::GROW);
  set_masses();
}

FixCDEMShape::~FixCDEMShape() { atom->delete_callback(id, Atom::GROW); }

// Reads "T TEMPLATE", after the word type.
void FixCDEMShape::read_template(Shearbox::DeckWords &words) {
  const int type = words.integer("type");
  if (type < 1 || type > atom->ntypes)
    error->all(FLERR, "Fix cdem/shape: type {} must be between 1 and {}", type, atom->ntypes);
  if (shapes[type])
    error->all(FLERR, "Fix cdem/shape: type {} has two templates", type);

  const std::string word = words.choice();
  std::string source = word;
  std::vector<Member> discs;
  if (word == "single" || word == "triple") {
    shapes[type] = word == "single" ? cdem::GrainShape::single() : cdem::GrainShape::triple();
    return;
  } else if (word == "line") {
    shapes[type] = read_line(words);
    return;
  } else if (word == "discs") {
    discs = read_discs(words);
  } else if (word == "file") {
    const std::string name = std::filesystem::path(folder) / words.word(fmt::format("type {}: file: its name", type));
    source += " " + name;
    discs = read_file(name);
  } else {
    error->all(FLERR, "Fix cdem/shape: type {}: unknown template {}; allowed: single, triple, discs, file, line", type,
               word);
  }
  try {
    shapes[type].emplace(discs);
  } catch (const std::invalid_argument &bad) {
    error->all(FLERR, "Fix cdem/shape: type {}, {}: {}", type, source, bad.what());
  }
}

cdem::GrainShape FixCDEMShape::read_line(Shearbox::DeckWords &words) const {
  const double ux = words.finite("line UX"), uy = words.finite("line UY"), length = std::hypot(ux, uy);
  if (!(length > 0))
    error->all(FLERR, "Fix cdem/shape: line {} {}: must be a vector that is not zero", ux, uy);
  return cdem::GrainShape::line(ux / length, uy / length);
}

std::vector<Member> FixCDEMShape::read_discs(Shearbox::DeckWords &words) const {
  const int n = words.integer("discs");
  if (n < 1 || n > words.left() / 3)
    error->all(FLERR, "Fix cdem/shape: discs {}: must be a positive number of discs, each with x y r; {} values follow",
               n, words.left());
  std::vector<Member> discs;
  for (int k = 1; k <= n; k++) {
    const std::string disc = " of disc " + std::to_string(k);
    const double x = words.number("x" + disc), y = words.number("y" + disc), r = words.number("r" + disc);
    discs.push_back({x, y, r});
  }
  return discs;
}

std::vector<Member> FixCDEMShape::read_file(const std::string &name) const {
  std::ifstream file(name);
  if (std::filesystem::is_directory(name))
    error->all(FLERR, "Fix cdem/shape: the template file {} is a folder", name);
  if (!file)
    error->all(FLERR, "Fix cdem/shape: can't read the template file {}: {}", name, utils::getsyserror());
  std::vector<Member> discs;
  std::string line;
  for (int number = 1; std::getline(file, line); number++) {
    std::istringstream words(line.substr(0, line.find('#')));
    Member d;
    std::string rest;
    if (!(words >> std::ws) || words.eof())
      continue;
    if (std::any_of(line.begin(), line.end(), [](unsigned char c) { return c < ' ' && !std::isspace(c); }))
      error->all(FLERR, "Fix cdem/shape: {} line {} is not text", name, number);
    if (!(words >> d.x >> d.y >> d.r) || words >> rest)
      error->all(FLERR, "Fix cdem/shape: {} line {} is not 'x y r': {}", name, number, line.substr(0, 60));
    discs.push_back(d);
  }
  return discs;
}

int FixCDEMShape::setmask() { return 0; }

void FixCDEMShape::init() {
  set_masses();
  refuse_masses_of_circles();
}

double FixCDEMShape::compute_array(int row, int column) {
  const cdem::GrainShape &shape = *shapes[row + 1];
  double largest = 0;
  for (const Member &d : shape.discs())
    largest = std::max(largest, d.r);
  const double outputs[] = {static_cast<double>(shape.discs().size()), 1 / largest, share(row + 1)};
  return outputs[column];
}

void FixCDEMShape::set_masses() const {
  for (int i = 0; i < atom->nlocal; i++)
    set_mass(i);
}

void FixCDEMShape::set_mass(int i) const {
  if (density > 0 && (atom->mask[i] & groupbit))
    atom->rmass[i] = density * shapes[atom->type[i]]->area() * atom->radius[i] * atom->radius[i];
}

double FixCDEMShape::share(int type) const { return shapes[type]->area() / M_PI; }

// If two types have the same mass per area of their circles, but fill different shares of these, they differ in
// density: nobody means that, but "set density/disc" does it. Only grains are looked at: the mass of a wall does not
// matter. Known of each type are the smallest and the largest value of its atoms.
void FixCDEMShape::refuse_masses_of_circles() const {
  constexpr double ROUNDING = 1e-12;
  const FixCDEMGrains *const grains = FixCDEMGrains::find(lmp);
  if (!grains || !grains->are_moved())
    return;
  const auto per_circle = [this](int i) { return atom->rmass[i] / (M_PI * atom->radius[i] * atom->radius[i]); };
  std::vector<double> mine(2 * shapes.size(), -INFINITY), all(mine); // by type, the largest value and that of -value
  for (int i = 0; i < atom->nlocal; i++) {
    double *const extremes = &mine[2 * atom->type[i]];
    extremes[0] = std::max(extremes[0], per_circle(i));
    extremes[1] = std::max(extremes[1], -per_circle(i));
  }
  MPI_Allreduce(mine.data(), all.data(), int(mine.size()), MPI_DOUBLE, MPI_MAX, world);
  for (int i = 0; i < atom->nlocal; i++) {
    const int own = atom->type[i];
    if (!grains->is_free(i) || shapes[own]->discs().size() == 1 || (density > 0 && (atom->mask[i] & groupbit)))
      continue;
    for (int other = 1; other <= atom->ntypes; other++)
      for (const double known : {all[2 * other], -all[2 * other + 1]})
        if (std::fabs(share(other) - share(own)) > ROUNDING &&
            std::fabs(known - per_circle(i)) <= ROUNDING * per_circle(i))
          error->one(FLERR,
                     "Fix cdem/shape: atom {} of type {} has mass {:.6g}, that of the circle around it with {:.6g} "
                     "kg/m^2 as of type {}; its discs have {:.6g}: give the fix 'density {:.6g}', or "
                     "'density {:.10g}' if that mass is meant",
                     atom->tag[i], own, atom->rmass[i], known, other, share(own) * atom->rmass[i], known,
                     known / share(own));
  }
}

void FixCDEMShape::set_arrays(int i) { set_mass(i); }

double FixCDEMShape::first_angle(int i) const {
  if (seed == 0 || !(atom->mask[i] & groupbit))
    return 0;
  std::seed_seq key{seed, int(atom->tag[i])};
  std::mt19937_64 random(key);
  return 2 * M_PI * std::ldexp(double(random() >> 11), -53);
}
