// SPDX-License-Identifier: GPL-2.0-or-later
#include "motion/fix_cdem_integrate.h"

#include "contacts/pair_cdem.h"
#include "core/stability.h"
#include "grains/fix_cdem_audit.h"
#include "grains/fix_cdem_shape.h"
#include "host/find_fix.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "update.h"
#include "utils.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

namespace {
constexpr double OF_WORST_PACKING = 0.9;
constexpr double OF_CONTACTS = 0.8; // they change; and with it a shear test's error of energy is below 0.01 %
constexpr double UNKNOWN = NAN;
constexpr int KEEP_EVERY = 5000; // steps
} // namespace

FixCDEMIntegrate *FixCDEMIntegrate::find(LAMMPS *lmp) { return Shearbox::find_fix<FixCDEMIntegrate>(lmp); }

FixCDEMIntegrate::FixCDEMIntegrate(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), guard(lmp), contacts(lmp, this), max_step(INFINITY) {
  if (domain->dimension != 2)
    error->all(FLERR, "Fix cdem/integrate: dimension is {}, must be 2", domain->dimension);
  if (!atom->sphere_flag)
    error->all(FLERR, "Fix cdem/integrate needs atom_style sphere");
  if (find(lmp))
    error->all(FLERR, "Fix cdem/integrate {}: there is one already, {}", id, find(lmp)->id);

  for (int iarg = 3; iarg < narg;) {
    if (strcmp(arg[iarg], "dt") == 0)
      parse_step_rule(narg, arg, ++iarg);
    else if (strcmp(arg[iarg], "rescue") == 0)
      parse_rescue(narg, arg, ++iarg);
    else if (const int used = parse_body_force(narg - iarg, arg + iarg))
      iarg += used;
    else
      error->all(FLERR,
                 "Fix cdem/integrate: unknown keyword {}; allowed: dt check|any|auto [MAX]|contacts [MAX], "
                 "gravity GX GY, drag T, rescue FILE|none",
                 arg[iarg]);
  }

  time_integrate = 1;
  scalar_flag = 1;
  peratom_flag = 1;
  size_peratom_cols = NCOLUMNS;
  peratom_freq = 1;
  create_attribute = 1;
  restart_global = 1;
  restart_peratom = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
  nevery = KEEP_EVERY;
  comm_forward = 1;
  FixCDEMIntegrate::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  for (int i = 0; i < atom->nlocal; i++)
    FixCDEMIntegrate::set_arrays(i);
}

void FixCDEMIntegrate::parse_step_rule(int narg, char **arg, int &iarg) {
  const std::string word = iarg < narg ? arg[iarg++] : "nothing";
  if (word == "check")
    rule = Step::check;
  else if (word == "any")
    rule = Step::any;
  else if (word == "auto")
    rule = Step::automatic;
  else if (word == "contacts")
    rule = Step::contacts;
  else
    error->all(FLERR, "Fix cdem/integrate: dt {}: must be check, any, auto or contacts", word);
  if (chooses_step() && iarg < narg && utils::is_double(arg[iarg])) {
    max_step = number("dt", narg, arg, iarg);
    if (!(max_step > 0))
      error->all(FLERR, "Fix cdem/integrate: dt {} {}: the maximum must be positive", word, max_step);
  }
}

void FixCDEMIntegrate::parse_rescue(int narg, char **arg, int &iarg) {
  if (iarg >= narg)
    error->all(FLERR, "Fix cdem/integrate: rescue: a file or none must follow");
  const std::string file = arg[iarg++];
  guard.set_file(file == "none" ? "" : file);
}

// Arguments that were used, 0 if the first is no keyword of this.
int FixCDEMIntegrate::parse_body_force(int narg, char **arg) {
  int iarg = 1;
  if (strcmp(arg[0], "gravity") == 0) {
    for (double &component : gravity)
      component = number("gravity", narg, arg, iarg);
  } else if (strcmp(arg[0], "drag") == 0) {
    if (narg > 1 && strcmp(arg[1], "none") == 0) {
      drag = 0;
      return 2;
    }
    const double time = number("drag", narg, arg, iarg);
    if (!(time > 0))
      error->all(FLERR, "Fix cdem/integrate: drag {}: the time must be positive (s), or none", time);
    drag = 1 / time;
  } else {
    return 0;
  }
  return iarg;
}

int FixCDEMIntegrate::modify_param(int narg, char **arg) { return parse_body_force(narg, arg); }

double FixCDEMIntegrate::number(const char *keyword, int narg, char **arg, int &iarg) const {
  if (iarg >= narg)
    error->all(FLERR, "Fix cdem/integrate: {} has too few values", keyword);
  const double value = utils::numeric(FLERR, arg[iarg++], false, lmp);
  if (!std::isfinite(value))
    error->all(FLERR, "Fix cdem/integrate: {} {} must be a finite number", keyword, value);
  return value;
}

FixCDEMIntegrate::~FixCDEMIntegrate() {
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
  memory->destroy(state);
}

int FixCDEMIntegrate::setmask() {
  return FixConst::INITIAL_INTEGRATE | FixConst::PRE_EXCHANGE | FixConst::POST_NEIGHBOR | FixConst::POST_FORCE |
         FixConst::FINAL_INTEGRATE | FixConst::END_OF_STEP;
}

void FixCDEMIntegrate::init() {
  if (!dynamic_cast<PairCDEM *>(force->pair))
    error->all(FLERR, "Fix cdem/integrate needs pair_style cdem");
  refuse_second_integrator();
  audit = FixCDEMAudit::find(lmp);
  inertia.assign(1, 0);
  for (int type = 1; type <= atom->ntypes; type++)
    inertia.push_back(FixCDEMShape::shape(lmp, type).inertia());
  limit = scene_minimum(cdem::step_limit);
  apply_step_rule();
  reset_dt();
}

// The smallest value over all grains, each as if surrounded by its like.
template <class Value> double FixCDEMIntegrate::scene_minimum(Value value) const {
  const auto *pair = static_cast<PairCDEM *>(force->pair);
  double smallest = INFINITY;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_free(i))
      continue;
    const cdem::GrainShape &shape = FixCDEMShape::shape(lmp, atom->type[i]);
    for (int other = 1; other <= atom->ntypes; other++)
      smallest = std::min(smallest, value(pair->material(atom->type[i], other), shape, atom->rmass[i]));
  }
  double all;
  MPI_Allreduce(&smallest, &all, 1, MPI_DOUBLE, MPI_MIN, world);
  return all;
}

void FixCDEMIntegrate::reset_dt() {
  const double dt = update->dt;
  const double least = scene_minimum([dt](const auto &...grain) { return cdem::prediction_weight(grain..., dt); });
  weight = std::min(least, 1.0); // infinite without grains
  static_cast<PairCDEM *>(force->pair)->renew_constants();
}

// The styles of this package look to it themselves.
void FixCDEMIntegrate::refuse_second_integrator() const {
  for (int k = 0; k < modify->nfix; k++) {
    const Fix *const other = modify->fix[k];
    if (!other->time_integrate || utils::strmatch(other->style, "^cdem/"))
      continue;
    for (int i = 0; i < atom->nlocal; i++)
      if (is_free(i) && (atom->mask[i] & other->groupbit))
        error->one(FLERR, "Fix cdem/integrate {}: fix {} of style {} moves grains of its group too", id, other->id,
                   other->style);
  }
}

void FixCDEMIntegrate::apply_step_rule() {
  if (chooses_step()) {
    set_step(kept.step > 0 ? kept.step : at_most_max(OF_WORST_PACKING * limit));
  } else if (!(update->dt > 0 && std::isfinite(update->dt))) {
    error->all(FLERR, "Fix cdem/integrate: the time step {} must be positive", update->dt);
  } else if (rule == Step::check && update->dt > limit) {
    error->all(FLERR,
               "Fix cdem/integrate: the time step {:.4g} is beyond the stability limit {:.4g} of this scene (smallest "
               "grain, stiffest contact); take a smaller one, 'dt auto', or 'dt any' to run all the same",
               update->dt, limit);
  }
}

double FixCDEMIntegrate::at_most_max(double step) const {
  step = std::min(step, max_step);
  if (!std::isfinite(step))
    error->all(FLERR, "Fix cdem/integrate: no time step: there is no grain in the group, and no MAX");
  return step;
}

void FixCDEMIntegrate::set_step(double step) {
  if (step == update->dt)
    return;
  update->update_time();
  update->dt = step;
  update->dt_default = 0;
  force->pair->reset_dt();
  for (int i = 0; i < modify->nfix; i++)
    modify->fix[i]->reset_dt();
  if (comm->me == 0)
    utils::logmesg(lmp, "Fix cdem/integrate: time step {:.4g} s, stability limit of the worst packing {:.4g} s\n", step,
                   limit);
}

bool FixCDEMIntegrate::knows_acceleration(int i) const {
  return kept.valid_step == update->ntimestep && !std::isnan(state[i][AX]);
}

void FixCDEMIntegrate::take_acceleration(int i) {
  state[i][AX] = inverses[i].mass * atom->f[i][0];
  state[i][AY] = inverses[i].mass * atom->f[i][1];
  state[i][ALPHA] = inverses[i].inertia * atom->torque[i][2];
}

// Divisions, done once for many steps.
void FixCDEMIntegrate::post_neighbor() {
  inverses.resize(atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++) {
    const double m = atom->rmass[i], r = atom->radius[i];
    inverses[i] = is_free(i) ? Inverse{1 / m, 1 / (m * r * r * inertia[atom->type[i]])} : Inverse{0, 0};
  }
}

// Other fixes may still add to the forces in their setup: what is taken here is for output, the first step takes it
// anew.
void FixCDEMIntegrate::setup(int) {
  post_neighbor();
  guard.begin(smallest_disc());
  if (rule == Step::contacts && kept.step == 0)
    choose_kept_step();
  warned = false;
  compare_with_contacts();
  post_force(0);
  to_start.clear();
  for (int i = 0; i < atom->nlocal; i++) {
    if (is_free(i) && !knows_acceleration(i)) {
      take_acceleration(i);
      to_start.push_back(i);
    }
    if (std::isnan(state[i][AX]))
      state[i][AX] = 0;
  }
  kept.valid_step = update->ntimestep;
}

double FixCDEMIntegrate::smallest_disc() const {
  double mine = INFINITY, all;
  for (int i = 0; i < atom->nlocal; i++)
    for (const auto &disc : FixCDEMShape::shape(lmp, atom->type[i]).discs())
      mine = std::min(mine, atom->radius[i] * disc.r);
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_MIN, world);
  return all;
}

// Contacts are known from setup on, too late for init().
void FixCDEMIntegrate::choose_kept_step() {
  const double stable = contact_limit(INFINITY);
  if (!std::isfinite(stable))
    return;
  if (comm->me == 0)
    utils::logmesg(lmp, "Fix cdem/integrate: stability limit of the contacts {:.4g} s\n", stable);
  kept.step = at_most_max(OF_CONTACTS * stable);
  set_step(kept.step);
}

// The limit of the scene knows neighbours of a grain's own kind only: a large grain among many small wall discs has
// less.
void FixCDEMIntegrate::compare_with_contacts() {
  if (warned)
    return;
  const double stable = contact_limit(update->dt);
  warned = update->dt > stable;
  if (warned && comm->me == 0)
    error->warning(FLERR,
                   "Fix cdem/integrate: at step {} the time step {:.4g} is beyond the stability limit {:.4g} of the "
                   "contacts there are: grains will not come to rest, and results are wrong",
                   update->ntimestep, update->dt, stable);
}

// Before LAMMPS loses a grain.
void FixCDEMIntegrate::pre_exchange() {
  guard.check();
  guard.check_box();
}

void FixCDEMIntegrate::end_of_step() {
  guard.keep();
  compare_with_contacts();
}

void FixCDEMIntegrate::initial_integrate(int) {
  if (guard.is_due())
    guard.check();
  for (int i : to_start)
    take_acceleration(i);
  to_start.clear();

  const double dt = update->dt, half = 0.5 * dt;
  const int n = atom->nlocal, *const mask = atom->mask;
  double *x = n ? atom->x[0] : nullptr, *v = n ? atom->v[0] : nullptr, *omega = n ? atom->omega[0] : nullptr;
  double *s = n ? state[0] : nullptr;
  for (int i = 0; i < n; i++, x += 3, v += 3, omega += 3, s += NCOLUMNS) {
    if (!(mask[i] & groupbit))
      continue;
    v[0] += half * s[AX];
    v[1] += half * s[AY];
    omega[2] += half * s[ALPHA];
    x[0] += dt * v[0];
    x[1] += dt * v[1];
    s[ANGLE] += dt * omega[2];
  }
}

cdem::StepRule FixCDEMIntegrate::step_rule() const {
  return {update->dt, 0.5 * update->dt * weight, gravity[0], gravity[1], drag};
}

void FixCDEMIntegrate::post_force(int) {
  if (!step_rule().has_body_forces())
    return;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_free(i))
      continue;
    for (int k = 0; k < 2; k++)
      atom->f[i][k] += atom->rmass[i] * (gravity[k] - drag * atom->v[i][k]);
  }
  if (!update->setupflag)
    book_drag_at([this](int i) { return std::pair(atom->v[i][0], atom->v[i][1]); });
}

void FixCDEMIntegrate::book_drag(const GrainRows &rows) {
  book_drag_at([&](int i) { return std::pair(rows.of_grain(i).vx_half, rows.of_grain(i).vy_half); });
}

// At the velocity of the half step, the middle of what is booked.
template <class Velocity> void FixCDEMIntegrate::book_drag_at(Velocity velocity) {
  if (!audit || drag == 0)
    return;
  double power = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_free(i))
      continue;
    const auto [vx, vy] = velocity(i);
    power += drag * atom->rmass[i] * (vx * vx + vy * vy);
  }
  audit->books.drag += update->dt * power;
}

void FixCDEMIntegrate::final_integrate() {
  const double half = 0.5 * update->dt;
  const int n = atom->nlocal, *const mask = atom->mask;
  const double *f = n ? atom->f[0] : nullptr, *torque = n ? atom->torque[0] : nullptr;
  double *v = n ? atom->v[0] : nullptr, *omega = n ? atom->omega[0] : nullptr, *s = n ? state[0] : nullptr;
  for (int i = 0; i < n; i++, v += 3, omega += 3, f += 3, torque += 3, s += NCOLUMNS) {
    if (!(mask[i] & groupbit))
      continue;
    s[AX] = inverses[i].mass * f[0];
    s[AY] = inverses[i].mass * f[1];
    s[ALPHA] = inverses[i].inertia * torque[2];
    v[0] += half * s[AX];
    v[1] += half * s[AY];
    omega[2] += half * s[ALPHA];
  }
  kept.valid_step = update->ntimestep;
}

double FixCDEMIntegrate::compute_scalar() { return limit; }

int FixCDEMIntegrate::pack_forward_comm(int n, int *list, double *buf, int, int *) {
  return contacts.pack(n, list, buf);
}

void FixCDEMIntegrate::unpack_forward_comm(int n, int first, double *buf) { contacts.unpack(n, first, buf); }

double FixCDEMIntegrate::memory_usage() { return double(atom->nmax) * NCOLUMNS * sizeof(double) + guard.bytes(); }

void FixCDEMIntegrate::grow_arrays(int nmax) {
  memory->grow(state, nmax, int(NCOLUMNS), "cdem/integrate:state");
  array_atom = state;
}

void FixCDEMIntegrate::copy_arrays(int i, int j, int) { std::copy_n(state[i], int(NCOLUMNS), state[j]); }

void FixCDEMIntegrate::set_arrays(int i) {
  std::fill_n(state[i], int(NCOLUMNS), 0.0);
  const bool running = update->whichflag != 0; // no setup() follows, and the atom had no step to be accelerated in
  if (!running)
    state[i][AX] = UNKNOWN;
}

int FixCDEMIntegrate::pack_exchange(int i, double *buf) {
  std::copy_n(state[i], int(NCOLUMNS), buf);
  return NCOLUMNS;
}

int FixCDEMIntegrate::unpack_exchange(int i, double *buf) {
  std::copy_n(buf, int(NCOLUMNS), state[i]);
  return NCOLUMNS;
}

void FixCDEMIntegrate::write_restart(FILE *fp) {
  if (comm->me != 0)
    return;
  const int size = sizeof(kept);
  fwrite(&size, sizeof(size), 1, fp);
  fwrite(&kept, sizeof(kept), 1, fp);
}

void FixCDEMIntegrate::restart(char *buf) { memcpy(&kept, buf, sizeof(kept)); }

int FixCDEMIntegrate::pack_restart(int i, double *buf) {
  buf[0] = NCOLUMNS + 1;
  std::copy_n(state[i], int(NCOLUMNS), buf + 1);
  return NCOLUMNS + 1;
}

// atom->extra holds the data of all fixes one after the other, each block with its length in front.
void FixCDEMIntegrate::unpack_restart(int i, int nth) {
  const double *block = atom->extra[i];
  for (int skip = 0; skip < nth; skip++)
    block += int(*block);
  std::copy_n(block + 1, int(NCOLUMNS), state[i]);
}

int FixCDEMIntegrate::size_restart(int) { return NCOLUMNS + 1; }

int FixCDEMIntegrate::maxsize_restart() { return NCOLUMNS + 1; }
