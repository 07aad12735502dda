// SPDX-License-Identifier: GPL-2.0-or-later
#include "liggghts/fix_integrate.h"

#include "liggghts/accumulation.h"

#include "comm.h"
#include "domain.h"
#include "force.h"
#include "memory.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

namespace Liggghts {

namespace {
constexpr double OF_LIMIT = 0.9;
constexpr int VELOCITIES = 3; // vx, vy, omega
constexpr int GROW = 0;       // of Atom::add_callback: arrays with an entry per atom
} // namespace

FixIntegrate::FixIntegrate(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg), max_step(INFINITY) {
  if (domain->dimension != 2)
    stop(lmp, "Fix cdem/integrate: dimension is ", domain->dimension, ", must be 2");
  if (!atom->radius_flag || !atom->rmass_flag)
    stop(lmp, "Fix cdem/integrate needs atom_style sphere");
  if (find_fix<FixIntegrate>(lmp))
    stop(lmp, "Fix cdem/integrate: there is one already");
  Words words(lmp, "Fix cdem/integrate", narg, arg, 3);
  while (!words.done()) {
    const std::string keyword = words.word("keyword");
    if (keyword == "drag")
      read_drag(words);
    else if (keyword == "dt") {
      const std::string choice = words.word("dt");
      if (choice != "check" && choice != "any" && choice != "auto")
        stop(lmp, "Fix cdem/integrate: dt ", choice, ": must be check, any or auto");
      rule = choice == "any" ? Rule::any : choice == "auto" ? Rule::automatic : Rule::check;
      if (rule == Rule::automatic && words.number_follows())
        max_step = words.positive("dt auto");
    } else
      stop(lmp, "Fix cdem/integrate: unknown keyword ", keyword, "; allowed: dt, drag");
  }
  time_integrate = create_attribute = 1;
  scalar_flag = vector_flag = peratom_flag = 1;
  global_freq = peratom_freq = 1;
  size_vector = NOUTPUTS;
  size_peratom_cols = NCOLUMNS;
  comm_forward = VELOCITIES;
  FixIntegrate::grow_arrays(atom->nmax);
  atom->add_callback(GROW);
  for (int i = 0; i < atom->nlocal; i++)
    FixIntegrate::set_arrays(i);
}

FixIntegrate::~FixIntegrate() {
  atom->delete_callback(id, GROW);
  memory->destroy(of_grain);
  memory->destroy(velocities);
}

int FixIntegrate::setmask() {
  using namespace FixConst;
  return INITIAL_INTEGRATE | PRE_FORCE | POST_FORCE | FINAL_INTEGRATE;
}

void FixIntegrate::read_drag(Words &words) {
  drag = words.number_follows() ? 1 / words.positive("drag") : 0;
  if (drag == 0)
    words.keyword("none");
}

int FixIntegrate::modify_param(int narg, char **arg) {
  const std::string keyword = arg[0];
  Words words(lmp, std::string("Fix_modify ") + id, narg, arg, 1);
  if (keyword == "drag")
    read_drag(words);
  else if (keyword == "omega")
    set_spins(words.number("omega"));
  else
    return 0;
  return words.taken() + 1;
}

void FixIntegrate::set_spins(double omega) {
  for (int i = 0; i < atom->nlocal; i++)
    if (!is_wall(i))
      atom->omega[i][2] = omega;
}

// The smallest value over all grains, each as if surrounded by equal grains.
template <class Value> double FixIntegrate::scene_minimum(Value value) const {
  static const cdem::GrainShape DISC = cdem::GrainShape::single();
  const Accumulation &law = Accumulation::needed_by("Fix cdem/integrate", lmp);
  double smallest = INFINITY;
  for (int i = 0; i < atom->nlocal; i++)
    for (int other = 1; other <= law.types() && !is_wall(i); other++)
      smallest =
          std::min(smallest,
                   value(cdem::AmongItsLike{
                       DISC, atom->rmass[i], atom->radius[i], DISC.inertia(), law.material(atom->type[i], other), {}}));
  return smallest_of_ranks(lmp, smallest);
}

void FixIntegrate::init() {
  limit = scene_minimum(cdem::step_limit);
  choose_step();
  reset_dt();
}

void FixIntegrate::choose_step() {
  if (rule == Rule::check && update->dt > limit)
    stop(lmp, "Fix cdem/integrate: the time step ", update->dt, " is beyond the stability limit ", limit,
         " of this scene (smallest grain, stiffest contact); take a smaller one, 'dt auto', or 'dt any'");
  const double step = std::min(OF_LIMIT * limit, max_step);
  if (rule != Rule::automatic || step == update->dt)
    return;
  if (!std::isfinite(step))
    stop(lmp, "Fix cdem/integrate: no time step: there is no grain in the group, and no MAX");
  update->update_time();
  update->dt = step;
  force->pair->reset_dt();
  for (int k = 0; k < modify->nfix; k++)
    modify->fix[k]->reset_dt();
}

void FixIntegrate::reset_dt() {
  const double dt = update->dt;
  weight = std::min(1.0, scene_minimum([dt](const auto &grain) { return cdem::prediction_weight(grain, dt); }));
}

void FixIntegrate::setup_pre_force(int) { carry_forward(0); }
void FixIntegrate::pre_force(int) { carry_forward(0.5 * weight * update->dt); }

void FixIntegrate::carry_forward(double time) {
  for (int i = 0; i < atom->nlocal; i++) {
    velocities[i][X] = atom->v[i][0] + time * of_grain[i][X];
    velocities[i][Y] = atom->v[i][1] + time * of_grain[i][Y];
    velocities[i][TURN] = atom->omega[i][2] + time * of_grain[i][TURN];
  }
  comm->forward_comm_fix(this);
}

// The forces are those of the last step, all of them.
void FixIntegrate::initial_integrate(int) {
  const double dt = update->dt;
  for (int i = 0; i < atom->nlocal; i++) {
    if (is_wall(i))
      continue;
    double *const x = atom->x[i], *const v = atom->v[i], *const f = atom->f[i], &omega = atom->omega[i][2];
    double *const own = of_grain[i];
    const double m = atom->rmass[i], r = atom->radius[i];
    own[X] = f[0] / m, own[Y] = f[1] / m, own[TURN] = atom->torque[i][2] / (0.5 * m * r * r);
    v[0] += 0.5 * dt * own[X];
    v[1] += 0.5 * dt * own[Y];
    omega += 0.5 * dt * own[TURN];
    x[0] += dt * v[0];
    x[1] += dt * v[1];
    own[PATH] += dt * std::sqrt(v[0] * v[0] + v[1] * v[1]);
    own[TURNED] += dt * std::fabs(omega);
    own[ANGLE] += dt * omega;
  }
}

void FixIntegrate::post_force(int) {
  if (drag == 0)
    return;
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 2 && !is_wall(i); k++)
      atom->f[i][k] -= atom->rmass[i] * drag * atom->v[i][k];
}

void FixIntegrate::final_integrate() {
  const double half = 0.5 * update->dt;
  for (int i = 0; i < atom->nlocal; i++) {
    if (is_wall(i))
      continue;
    const double m = atom->rmass[i], r = atom->radius[i];
    atom->v[i][0] += half / m * atom->f[i][0];
    atom->v[i][1] += half / m * atom->f[i][1];
    atom->omega[i][2] += half / (0.5 * m * r * r) * atom->torque[i][2];
  }
}

double FixIntegrate::compute_vector(int n) {
  switch (n) {
  case TRM:
    return mean_trm();
  case UNBALANCED:
    return unbalanced();
  case TRANSLATION:
    return sum_over_grains([this](int i) {
      const double *const v = atom->v[i];
      return 0.5 * atom->rmass[i] * (v[0] * v[0] + v[1] * v[1]);
    });
  case ROTATION:
    return sum_over_grains([this](int i) {
      const double rim = atom->radius[i] * atom->omega[i][2];
      return 0.25 * atom->rmass[i] * rim * rim;
    });
  default:
    return Accumulation::needed_by("Fix cdem/integrate", lmp).sums().spring_energy;
  }
}

template <class Term> double FixIntegrate::sum_over_grains(Term term) const {
  cdem::ExactSum mine;
  for (int i = 0; i < atom->nlocal; i++)
    if (!is_wall(i))
      mine.add(term(i));
  return over_ranks(lmp, mine);
}

double FixIntegrate::mean_trm() const {
  const double moved = sum_over_grains([this](int i) { return of_grain[i][PATH] > 0 ? 1 : 0; });
  const double sum = sum_over_grains([this](int i) {
    const double path = of_grain[i][PATH];
    return path > 0 ? atom->radius[i] * of_grain[i][TURNED] / path : 0;
  });
  return moved > 0 ? sum / moved : 0;
}

double FixIntegrate::unbalanced() const {
  const double grains = sum_over_grains([](int) { return 1; });
  const double net = sum_over_grains([this](int i) { return std::hypot(atom->f[i][0], atom->f[i][1]); });
  const Accumulation::Sums contacts = Accumulation::needed_by("Fix cdem/integrate", lmp).sums();
  return contacts.contacts > 0 ? net / grains / (contacts.normal_force / contacts.contacts) : INFINITY;
}

void FixIntegrate::grow_arrays(int nmax) {
  memory->grow(of_grain, nmax, int(NCOLUMNS), "cdem/integrate:of_grain");
  memory->grow(velocities, nmax, VELOCITIES, "cdem/integrate:velocities");
  array_atom = of_grain;
}

void FixIntegrate::copy_arrays(int i, int j, int) { std::copy_n(of_grain[i], int(NCOLUMNS), of_grain[j]); }
void FixIntegrate::set_arrays(int i) { std::fill_n(of_grain[i], int(NCOLUMNS), 0.0); }

int FixIntegrate::pack_exchange(int i, double *buf) {
  std::copy_n(of_grain[i], int(NCOLUMNS), buf);
  return NCOLUMNS;
}

int FixIntegrate::unpack_exchange(int i, double *buf) {
  std::copy_n(buf, int(NCOLUMNS), of_grain[i]);
  return NCOLUMNS;
}

// In a periodic box LIGGGHTS tells the shift of positions; velocities have none.
int FixIntegrate::pack_comm(int n, int *list, double *buf, int, int *) {
  for (int k = 0; k < n; k++)
    std::copy_n(velocities[list[k]], VELOCITIES, buf + k * VELOCITIES);
  return VELOCITIES;
}

void FixIntegrate::unpack_comm(int n, int first, double *buf) {
  for (int k = 0; k < n; k++)
    std::copy_n(buf + k * VELOCITIES, VELOCITIES, velocities[first + k]);
}

} // namespace Liggghts
