// SPDX-License-Identifier: GPL-2.0-or-later
#include "motion/fix_cdem_integrate.h"

#include "contacts/pair_cdem.h"
#include "grains/fix_cdem_shape.h"
#include "host/compat.h"
#include "host/deck_words.h"
#include "host/find_fix.h"
#include "host/fingerprint.h"
#include "host/packed_state.h"
#include "motion/wall_body.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "update.h"
#include "utils.h"

#include <cmath>
#include <string>
#include <vector>

using namespace LAMMPS_NS;

namespace {
constexpr int KEEP_EVERY = 5000; // steps
struct Kept {
  static constexpr int VERSION = 1;
  double step; // see StepChoice::kept_step
};
} // namespace

FixCDEMIntegrate *FixCDEMIntegrate::find(LAMMPS *lmp) { return Shearbox::find_fix<FixCDEMIntegrate>(lmp); }

FixCDEMIntegrate::FixCDEMIntegrate(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), guard(lmp), body_forces(lmp), step(lmp, this) {
  if (domain->dimension != 2)
    error->all(FLERR, "Fix cdem/integrate: dimension is {}, must be 2", domain->dimension);
  if (!Shearbox::is_sphere(atom))
    error->all(FLERR, "Fix cdem/integrate needs atom_style sphere");
  if (find(lmp))
    error->all(FLERR, "Fix cdem/integrate {}: there is one already, {}", id, find(lmp)->id);

  Shearbox::DeckWords words(lmp, "Fix cdem/integrate", narg, arg, 3);
  while (!words.done()) {
    if (words.take("dt"))
      step.parse(words);
    else if (words.take("inertia"))
      inertia_factor = words.positive("inertia");
    else if (words.take("rescue"))
      set_rescue(words.word("rescue: a file or none"));
    else if (!body_forces.parse(words))
      error->all(FLERR, "Fix cdem/integrate: unknown keyword {}; allowed: {}, {}, inertia F, rescue FILE|none",
                 words.word("a keyword"), StepChoice::WORDS, BodyForces::WORDS);
  }

  time_integrate = 1;
  scalar_flag = 1;
  extscalar = 0;
  peratom_flag = 1;
  size_peratom_cols = FixCDEMGrains::NCOLUMNS; // all: atom-style variables take it for the distance of two rows
  peratom_freq = 1;
  restart_global = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
  nevery = KEEP_EVERY;
  comm_forward = 1;
}

FixCDEMIntegrate::~FixCDEMIntegrate() {
  if (auto *const known = FixCDEMGrains::find(lmp))
    known->end_moving();
}

// LAMMPS does not let a fix make another one before this call.
void FixCDEMIntegrate::post_constructor() { take_grains(); }

void FixCDEMIntegrate::take_grains() {
  grains = FixCDEMGrains::find_or_make(lmp);
  grains->begin_moving(this);
}

void FixCDEMIntegrate::set_rescue(const std::string &file) { guard.set_file(file == "none" ? "" : file); }

int FixCDEMIntegrate::modify_param(int narg, char **arg) {
  Shearbox::DeckWords words(lmp, "Fix cdem/integrate", narg, arg);
  body_forces.parse(words);
  tell_grains();
  known_dt = 0; // the next step takes what depends on it anew, also in a run without a setup
  return words.read();
}

void FixCDEMIntegrate::tell_grains() {
  std::vector<double> inertia(1, 0);
  for (int type = 1; type <= atom->ntypes; type++)
    inertia.push_back(inertia_factor * FixCDEMShape::shape(lmp, type).inertia());
  grains->set_inertias(inertia);
  body_forces.tell_grains();
}

int FixCDEMIntegrate::setmask() {
  return FixConst::INITIAL_INTEGRATE | FixConst::PRE_EXCHANGE | FixConst::POST_NEIGHBOR | FixConst::PRE_FORCE |
         FixConst::PRE_REVERSE | FixConst::FINAL_INTEGRATE | FixConst::END_OF_STEP;
}

void FixCDEMIntegrate::init() {
  contacts = &PairCDEM::needed_by("Fix cdem/integrate", lmp)->contacts;
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix cdem/integrate: run_style {} must be verlet or verlet/cdem", update->integrate_style);
  if (FixCDEMGrains::find(lmp) != grains)
    take_grains(); // ours was deleted
  refuse_second_integrator();
  if (update->whichflag != 0) // else no run begins
    warn_of_belts();
  body_forces.init();
  tell_grains();
  settle_angles();
  refuse_lost_shapes();
  grains->set_shapes(contacts->rows.has_clumps() || contacts->rows.has_lines());
  step.init();
  reset_dt();
}

// Between two runs, where newer LAMMPS calls it for the command timestep, the scene is not known yet; init() takes it
// up.
void FixCDEMIntegrate::reset_dt() {
  if (update->whichflag == 0)
    return;
  known_dt = update->dt;
  step.check();
  grains->weight = step.prediction_weight();
  contacts->renew_constants();
  tell_rules();
}

void FixCDEMIntegrate::tell_rules() {
  Shearbox::Fingerprint rules;
  rules.add(PairCDEM::needed_by("Fix cdem/integrate", lmp)->rules());
  for (int type = 1; type <= atom->ntypes; type++) {
    const cdem::GrainShape &shape = FixCDEMShape::shape(lmp, type);
    for (const auto &disc : shape.discs())
      rules.add(disc.x).add(disc.y).add(disc.r);
    if (shape.is_line())
      rules.add(shape.axis(1).ux).add(shape.axis(1).uy);
    rules.add(grains->inertia(type));
  }
  const cdem::StepRule made = grains->step_rule();
  grains->set_rules(rules.add(made.gx).add(made.gy).add(made.drag).add(made.damping).add(made.dt).value());
}

void FixCDEMIntegrate::refuse_lost_shapes() const {
  if (grains->may_have_shapes() && !FixCDEMShape::find(lmp))
    error->all(FLERR,
               "Fix cdem/integrate {}: atoms had other shapes than a disc so far, and there is no fix cdem/shape: "
               "define it as it was, or with 'single' for all types to make them discs",
               id);
}

// Fixes that move walls (WallBody) check themselves that they have no grains.
void FixCDEMIntegrate::refuse_second_integrator() const {
  for (int k = 0; k < modify->nfix; k++) {
    const Fix *const other = modify->fix[k];
    if (!other->time_integrate || other == this || dynamic_cast<const WallBody *>(other))
      continue;
    for (int i = 0; i < atom->nlocal; i++)
      if (grains->is_free(i) && (atom->mask[i] & other->groupbit))
        error->one(FLERR, "Fix cdem/integrate {}: fix {} of style {} moves grains of its group too", id, other->id,
                   other->style);
  }
}

// A grain that has left the group keeps its velocity, and contacts would see it slide or turn in its place.
void FixCDEMIntegrate::warn_of_belts() const {
  int moved = groupbit; // groups that some fix moves
  for (int k = 0; k < modify->nfix; k++)
    if (modify->fix[k]->time_integrate)
      moved |= modify->fix[k]->groupbit;
  bigint mine = 0, all;
  for (int i = 0; i < atom->nlocal; i++)
    mine += !(atom->mask[i] & moved) && (atom->v[i][0] != 0 || atom->v[i][1] != 0 || atom->omega[i][2] != 0);
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all > 0 && comm->me == 0)
    error->warning(FLERR,
                   "Fix cdem/integrate {}: {} walls that no fix moves have a velocity or spin, and act as belts and "
                   "rollers; for walls at rest: velocity GROUP set 0 0 0, set group GROUP omega 0 0 0",
                   id, all);
}

// After all init(), where walls have got their velocities, and before atoms go to other ranks. Walls of no fix have no
// acceleration; those that had been grains would keep theirs. A step that is still to be chosen is another one than
// that of the forces.
void FixCDEMIntegrate::setup_pre_exchange() {
  for (int i = 0; i < atom->nlocal; i++)
    if (!grains->is_free(i))
      grains->set_acceleration(i, {0, 0, 0});
  goes_on = grains->scene_is_as_kept() && !step.is_to_be_chosen();
  if (!goes_on && grains->moved_against_each_other() && comm->me == 0)
    error->warning(FLERR,
                   "Fix cdem/integrate {}: grains were moved relative to each other since the last step, as by set, "
                   "displace_atoms or read_dump: contacts keep their springs, and grains their angles",
                   id);
}

// What follows from atoms and groups is prepared with a setup.
void FixCDEMIntegrate::check_preparation() {
  if (!is_prepared && grains->has_new_members())
    error->all(FLERR,
               "Fix cdem/integrate {}: atoms, their group, types, radii or masses have changed since the last run: the "
               "next one must not be 'pre no'",
               id);
  is_prepared = true;
}

void FixCDEMIntegrate::post_run() { is_prepared = false; }

void FixCDEMIntegrate::setup_post_neighbor() { post_neighbor(); }

// The contacts have to be known before the step can be chosen by them, and the step before they give the forces with
// which a run begins.
void FixCDEMIntegrate::setup_pre_force(int) {
  if (!step.is_to_be_chosen())
    return;
  force->pair->compute(0, 0);
  step.choose_by_contacts();
  for (int i = 0; i < atom->nlocal; i++) {
    std::fill_n(atom->f[i], 3, 0.0);
    std::fill_n(atom->torque[i], 3, 0.0);
  }
}

// Other fixes may still add to the forces in their setup(). So the accelerations taken here are for output only; the
// first step computes them again. A run that goes on has those of its last step, which do not change.
void FixCDEMIntegrate::setup(int) {
  guard.begin(smallest_disc(), step.scene_limit());
  step.begin_run();
  step.compare_with_contacts();
  if (!goes_on)
    take_accelerations();
  is_first = is_prepared = true;
}

void FixCDEMIntegrate::take_accelerations() {
  for (int i = 0; i < atom->nlocal; i++)
    if (grains->is_free(i))
      grains->set_acceleration(i, grains->acceleration_by_forces(i));
}

// Grains may have come.
void FixCDEMIntegrate::post_neighbor() {
  settle_angles();
  if (!step.sees_smaller_grains())
    return;
  grains->weight = step.prediction_weight();
  guard.set_limits(smallest_disc(), step.scene_limit());
}

void FixCDEMIntegrate::settle_angles() {
  const FixCDEMShape *const shape = FixCDEMShape::find(lmp);
  for (int i = 0; i < atom->nlocal; i++)
    if (std::isnan(grains->angle(i)))
      grains->angle(i) = shape ? shape->first_angle(i) : 0;
}

double FixCDEMIntegrate::smallest_disc() const {
  double mine = INFINITY, all;
  for (int i = 0; i < atom->nlocal; i++)
    for (const auto &disc : FixCDEMShape::shape(lmp, atom->type[i]).discs())
      mine = std::min(mine, atom->radius[i] * disc.r);
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_MIN, world);
  return all;
}

// Called before LAMMPS can lose a grain.
void FixCDEMIntegrate::pre_exchange() {
  guard.check();
  guard.check_box();
}

void FixCDEMIntegrate::end_of_step() {
  guard.keep();
  step.compare_with_contacts();
}

void FixCDEMIntegrate::initial_integrate(int) {
  check_preparation();
  if (update->dt != known_dt) // by timestep, before a run without a setup
    reset_dt();
  if (guard.is_due())
    guard.check();
  if (is_first)
    take_accelerations();
  is_first = false;

  const double dt = update->dt, half = 0.5 * dt;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!grains->is_free(i))
      continue;
    double *const x = atom->x[i], *const v = atom->v[i], &omega = atom->omega[i][2];
    const FixCDEMGrains::Acceleration a = grains->acceleration(i);
    v[0] += half * a.x;
    v[1] += half * a.y;
    omega += half * a.turn;
    x[0] += dt * v[0];
    x[1] += dt * v[1];
    grains->angle(i) += dt * omega;
  }
}

// Right after the contacts' forces: fixes that set forces, such as freeze, act on all of them, wherever they are
// defined.
void FixCDEMIntegrate::pre_reverse(int, int) {
  body_forces.add();
  grains->forces_are_there();
}

void FixCDEMIntegrate::setup_pre_reverse(int, int) {
  if (goes_on)
    grains->restore_forces();
  else
    body_forces.add();
}

void FixCDEMIntegrate::final_integrate() {
  const double half = 0.5 * update->dt;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!grains->is_free(i))
      continue;
    const FixCDEMGrains::Acceleration a = grains->acceleration_by_forces(i);
    grains->set_acceleration(i, a);
    atom->v[i][0] += half * a.x;
    atom->v[i][1] += half * a.y;
    atom->omega[i][2] += half * a.turn;
  }
  grains->step_is_done();
}

double FixCDEMIntegrate::compute_scalar() { return step.scene_limit(); }

int FixCDEMIntegrate::pack_forward_comm(int n, int *list, double *buf, int, int *) {
  return step.contacts.pack(n, list, buf);
}

void FixCDEMIntegrate::unpack_forward_comm(int n, int first, double *buf) { step.contacts.unpack(n, first, buf); }

double FixCDEMIntegrate::memory_usage() { return guard.bytes(); }

void FixCDEMIntegrate::write_restart(FILE *fp) {
  if (comm->me == 0)
    Shearbox::write_state(fp, Kept{step.kept_step});
}

void FixCDEMIntegrate::restart(char *buf) { step.kept_step = Shearbox::read_state<Kept>(lmp, style, buf).step; }
