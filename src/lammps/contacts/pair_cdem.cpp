// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/pair_cdem.h"

#include "contacts/fix_cdem_history.h"
#include "contacts/onlookers.h"
#include "core/denormals.h"
#include "grains/fix_cdem_grains.h"
#include "grains/fix_cdem_shape.h"
#include "host/compat.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <string>

using namespace LAMMPS_NS;

PairCDEM *PairCDEM::needed_by(const std::string &who, LAMMPS *lmp) {
  auto *const pair = dynamic_cast<PairCDEM *>(lmp->force->pair);
  if (!pair)
    lmp->error->all(FLERR, "{} needs pair_style cdem", who);
  return pair;
}

PairCDEM::PairCDEM(LAMMPS *lmp) : Pair(lmp), contacts(lmp, this), report(lmp, contacts), law(lmp) {
  restartinfo = 1;
  single_enable = 1;
  single_extra = 3;
  svector = new double[single_extra];
  no_virial_fdotr_compute = 1;
  centroidstressflag = CENTROID_NOTAVAIL;
  finitecutflag = 1;
  comm_forward = GrainRows::COMM_SIZE;
}

PairCDEM::~PairCDEM() {
  delete[] svector;
  if (allocated) {
    memory->destroy(setflag);
    memory->destroy(cutsq);
  }
  if (history && Shearbox::fix_by_id(lmp, FixCDEMHistory::ID))
    modify->delete_fix(FixCDEMHistory::ID);
}

void PairCDEM::allocate() {
  allocated = 1;
  const int n = atom->ntypes;
  memory->create(setflag, n + 1, n + 1, "pair:setflag");
  memory->create(cutsq, n + 1, n + 1, "pair:cutsq");
  for (int i = 1; i <= n; i++)
    std::fill_n(setflag[i], n + 1, 0);
  law.forget_coefficients();
}

void PairCDEM::settings(int narg, char **arg) { law.read_style(narg, arg); }

void PairCDEM::coeff(int narg, char **arg) {
  if (!allocated)
    allocate();
  if (narg < 2)
    error->all(FLERR, "Pair coeff cdem has {} arguments; needed: I J kn ks hn hs phi", narg);
  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);
  const cdem::Coefficients c = law.read_coefficients(narg - 2, arg + 2);
  int count = 0;
  for (int i = ilo; i <= ihi; i++)
    for (int j = std::max(jlo, i); j <= jhi; j++) {
      law.coefficients[i][j] = law.coefficients[j][i] = c;
      setflag[i][j] = 1;
      count++;
    }
  if (count == 0)
    error->all(FLERR, "Pair coeff cdem {} {} names no pair of types I <= J", arg[0], arg[1]);
}

void PairCDEM::check_setting() const {
  if (domain->dimension != 2)
    error->all(FLERR, "Pair style cdem: dimension is {}, must be 2", domain->dimension);
  if (force->ftm2v != 1)
    error->all(FLERR, "Pair style cdem: units {}: force must be mass times acceleration: si, cgs, lj, micro or nano",
               update->unit_style);
  if (force->newton_pair)
    error->all(FLERR, "Pair style cdem: newton is on, must be off ('newton off' before the box is made)");
  if (!Shearbox::is_sphere(atom))
    error->all(FLERR, "Pair style cdem needs atom_style sphere");
  // LAMMPS unsets comm_x_only if radii can change.
  if (const AtomVec *const sphere = atom->style_match("sphere"); sphere && !sphere->comm_x_only)
    error->all(FLERR, "Pair style cdem: atom_style sphere 1 must be sphere or sphere 0: radii cannot change in a run");
  if (!atom->tag_enable)
    error->all(FLERR, "Pair style cdem: atom_modify id no must be yes: contacts are remembered by the ids of grains");
  if (!comm->ghost_velocity)
    error->all(FLERR, "Pair style cdem needs 'comm_modify vel yes'");
  if (neighbor->includegroup || Shearbox::group_of_ghosts(*comm))
    error->all(FLERR,
               "Pair style cdem: neigh_modify include and comm_modify group must be all: atoms outside the group "
               "would touch nothing; walls have no contacts with each other anyway");
  if (!grains || !grains->are_moved())
    error->all(FLERR, "Pair style cdem needs a fix cdem/integrate: atoms outside its group are walls");
  if (const auto *shape = FixCDEMShape::find(lmp))
    shape->set_masses(); // pair styles are prepared before fixes, which may be defined in any order
  if (update->whichflag == 2)
    error->all(FLERR, "Pair style cdem: minimize makes no time steps, which contacts need; use run, with drag");
  if (Shearbox::command_in_work(lmp) == "rerun")
    error->all(FLERR,
               "Pair style cdem: rerun: a dump has neither the springs of contacts nor the angles of grains, and "
               "forces would be wrong: 'run 0' from restart files, or dump in the run what is needed");
  if (Shearbox::command_in_work(lmp) == "pair_write")
    error->all(FLERR, "Pair style cdem: pair_write: forces are not a function of the distance: contacts have a past");
  if (!(neighbor->skin > 0))
    error->all(FLERR,
               "Pair style cdem: the skin of the neighbour list is {}, must be positive: a contact still acts "
               "in the step in which it opens",
               neighbor->skin);
}

// At every rebuild too, since atoms may come in a run. LAMMPS looks for neighbours as far as the largest radii reach
// that were known as the run began.
void PairCDEM::check_atoms() const {
  for (int i = 0; i < atom->nlocal; i++) {
    const double radius = atom->radius[i], largest = largest_radius[atom->type[i]];
    if (!(radius > 0))
      error->one(FLERR, "Pair style cdem: atom {} has radius {}, must be positive", atom->tag[i], radius);
    if (!(atom->rmass[i] > 0))
      error->one(FLERR, "Pair style cdem: atom {} has mass {}, must be positive", atom->tag[i], atom->rmass[i]);
    if (atom->x[i][2] != 0)
      error->one(FLERR, "Pair style cdem: atom {} is at z = {}, must be 0: LAMMPS takes distances in three dimensions",
                 atom->tag[i], atom->x[i][2]);
    if (grains->is_free(i) && contacts.rows.shape_of_type(atom->type[i]).is_line())
      error->one(FLERR,
                 "Pair style cdem: atom {} of type {} is a piece of a wall (template line of fix cdem/shape), must not "
                 "be in the group of fix cdem/integrate",
                 atom->tag[i], atom->type[i]);
    if (radius > largest)
      error->one(FLERR,
                 "Pair style cdem: atom {} of type {} has radius {}, larger than all of its type as the run began, {}: "
                 "contacts would be missed; let such a grain be there when a run begins",
                 atom->tag[i], atom->type[i], radius, largest);
  }
}

void PairCDEM::init_style() {
  if (cdem::keep_denormals() && comm->me == 0)
    utils::logmesg(lmp, "Pair style cdem: denormal numbers were taken for 0, as by a library linked with -ffast-math; "
                        "they are not any more, since contacts remember them\n");
  grains = FixCDEMGrains::find(lmp);
  check_setting();
  find_largest_radii();
  check_periods();
  Shearbox::request_half_size_list(lmp, this, instance_me);
  if (history && !Shearbox::fix_by_id(lmp, FixCDEMHistory::ID))
    error->all(FLERR, "Pair style cdem: fix {}, which has the memory of the contacts, was removed: do not unfix it",
               FixCDEMHistory::ID);
  if (!history)
    history = static_cast<FixCDEMHistory *>(modify->add_fix(std::string(FixCDEMHistory::ID) + " all cdem/history"));
  contacts.init(law.table(), law.coefficients, law.instructions, history, contacts_are_looked_at(lmp));
  check_atoms();
  check_lines();
  if (update->whichflag != 0) // else no run begins
    warn_of_misreaders(lmp, scene());
}

Scene PairCDEM::scene() const {
  int mine = 0, walls;
  for (int i = 0; i < atom->nlocal; i++)
    mine = mine || !grains->is_free(i);
  MPI_Allreduce(&mine, &walls, 1, MPI_INT, MPI_MAX, world);
  return {contacts.rows.has_clumps(), walls != 0};
}

bool PairCDEM::resists_slip(const cdem::Coefficients &c) const {
  const cdem::TwoGrains::Grain any{1, 1, 1};
  const cdem::Resistance::Part turning = contacts.law.added_resistance(c, {any, any}).turning;
  return c.material.mu > 0 || turning.stiffness > 0 || turning.dashpot > 0;
}

// The angle of such a wall is not moved on: it would be drawn, and would act, as if it stood still.
void PairCDEM::check_turning_walls() const {
  for (int i = 0; i < atom->nlocal; i++) {
    const cdem::GrainShape &shape = contacts.rows.shape_of_type(atom->type[i]);
    if (atom->omega[i][2] != 0 && !grains->is_free(i) && (shape.is_line() || shape.discs().size() > 1))
      error->one(
          FLERR,
          "Pair style cdem: atom {} of type {} is a wall of several discs, or a piece of a smooth wall, and has a "
          "spin of {} rad/s: such walls do not turn; take walls of single discs, or set omega 0 0 0",
          atom->tag[i], atom->type[i], atom->omega[i][2]);
  }
}

// A contact with a wall's line remembers nothing: the disc may go from one piece of the wall to the next.
void PairCDEM::check_lines() const {
  for (int line = 1; line <= atom->ntypes; line++)
    for (int other = 1; other <= atom->ntypes && contacts.rows.shape_of_type(line).is_line(); other++)
      if (setflag[std::min(line, other)][std::max(line, other)] && resists_slip(law.coefficients[line][other]))
        error->all(FLERR,
                   "Pair style cdem: pair_coeff {} {}: atoms of type {} are pieces of a smooth wall (template line of "
                   "fix cdem/shape): phi and rolling must be 0",
                   std::min(line, other), std::max(line, other), line);
}

// Of the grains that are there, and of those that fixes pour and deposit will bring.
void PairCDEM::find_largest_radii() {
  std::vector<double> mine(atom->ntypes + 1, 0.0);
  for (int i = 0; i < atom->nlocal; i++)
    mine[atom->type[i]] = std::max(mine[atom->type[i]], atom->radius[i]);
  for (int k = 0; k < modify->nfix; k++)
    for (int type = 1; type <= atom->ntypes; type++) {
      int asked = type;
      if (utils::strmatch(modify->fix[k]->style, "^pour") || utils::strmatch(modify->fix[k]->style, "^deposit"))
        if (const void *const radius = modify->fix[k]->extract("radius", asked))
          mine[type] = std::max(mine[type], *static_cast<const double *>(radius));
    }
  largest_radius.resize(mine.size());
  MPI_Allreduce(mine.data(), largest_radius.data(), int(mine.size()), MPI_DOUBLE, MPI_MAX, world);
}

double PairCDEM::atom2cut(int i) { return 2 * atom->radius[i]; }

double PairCDEM::radii2cut(double r1, double r2) { return r1 + r2; }

// Two grains have one history for each pair of their discs, so they must not touch twice, on both sides of a period.
void PairCDEM::check_periods() const {
  const double needed = 4 * *std::max_element(largest_radius.begin(), largest_radius.end());
  for (int k = 0; k < 2; k++)
    if (domain->periodicity[k] && domain->prd[k] < needed)
      error->all(FLERR,
                 "Pair style cdem: the box is periodic over {} m in {}, must be {} m or more (two diameters of the "
                 "largest grain): two grains could touch on both sides",
                 domain->prd[k], k ? "y" : "x", needed);
}

double PairCDEM::init_one(int i, int j) {
  if (!setflag[i][j])
    error->all(FLERR, "Pair style cdem: no pair_coeff for types {} and {}", i, j);
  return largest_radius[i] + largest_radius[j];
}

void PairCDEM::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  GrainRows &rows = contacts.rows;
  const bool rebuilt = neighbor->ago == 0;
  if (rebuilt) {
    check_atoms();
    rows.map();
  }
  if (rebuilt || update->ntimestep == update->firststep + 1) // a fix that turns them has given them a spin by then
    check_turning_walls();

  // During a step, v and omega are those of the half step; at setup they are those of the full step.
  rows.fill(0, atom->nlocal, update->setupflag ? 0 : grains->step_rule().forward);
  rows.exchange_ghosts();
  if (rebuilt)
    contacts.rebuild(list);
  else
    contacts.refresh();
  contacts.forces(evflag ? [this](int k, const cdem::PairForce &f) { tally(k, f); } : DiscPairList::LookAtForce());
}

int PairCDEM::pack_forward_comm(int n, int *list, double *buf, int pbc_flag, int *pbc) {
  return contacts.rows.pack(n, list, buf, pbc_flag, pbc);
}

void PairCDEM::unpack_forward_comm(int n, int first, double *buf) { contacts.rows.unpack(n, first, buf); }

// Adds energy and virial of a contact to LAMMPS's sums. The branch vector is from grain centre to grain centre, or to
// the foot on a smooth wall: a piece of it has no centre that would matter.
void PairCDEM::tally(int k, const cdem::PairForce &f) {
  const int i = contacts.rows.grain(contacts.pairs.a(k)), j = contacts.rows.grain(contacts.pairs.b(k));
  const auto place = [this](int row, int grain) {
    const GrainRows &rows = contacts.rows;
    if (rows.shape_of_type(atom->type[grain]).is_line())
      return GrainRows::Vector{rows[row].x, rows[row].y};
    return GrainRows::Vector{atom->x[grain][0], atom->x[grain][1]};
  };
  const auto from = place(contacts.pairs.a(k), i), to = place(contacts.pairs.b(k), j);
  double energy = 0;
  if (eflag_either) {
    const auto [normal, tangential, added] = contacts.values.energy(k);
    energy = normal + tangential + added;
  }
  ev_tally_xyz(i, j, atom->nlocal, force->newton_pair, energy, 0, f.fx, f.fy, 0, from.x - to.x, from.y - to.y, 0);
}

double PairCDEM::single(int i, int j, int, int, double, double, double, double &fforce) {
  if (i >= atom->nlocal)
    std::swap(i, j);
  const ContactReport::OfPair sum = report.of_pair(i, j);
  fforce = sum.pull;
  svector[0] = sum.fn;
  svector[1] = sum.ft;
  svector[2] = sum.es;
  return sum.energy;
}

cdem::AmongItsLike PairCDEM::among_its_like(int i, int other_type) const {
  const int type = atom->type[i];
  const cdem::GrainShape &shape = FixCDEMShape::shape(lmp, type);
  const double m = atom->rmass[i], r = atom->radius[i], inertia = grains->inertia(type);
  double disc = 0; // the largest of the grain
  for (const auto &d : shape.discs())
    disc = std::max(disc, d.r * r);
  const cdem::TwoGrains::Grain grain{m, inertia * m * r * r, disc};
  const cdem::Coefficients &c = law.coefficients[type][other_type];
  return {shape, m, r, inertia, c.material, contacts.law.added_resistance(c, {grain, grain}), grains->damping};
}

void PairCDEM::write_restart(FILE *fp) { law.write(fp, setflag); }

void PairCDEM::read_restart(FILE *fp) {
  allocate();
  law.read(fp, setflag);
}

double PairCDEM::memory_usage() { return Pair::memory_usage() + contacts.bytes(); }
