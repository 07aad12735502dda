// SPDX-License-Identifier: GPL-2.0-or-later
#include "motion/step_choice.h"

#include "contacts/pair_cdem.h"
#include "core/stability.h"
#include "grains/fix_cdem_grains.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "modify.h"
#include "update.h"
#include "utils.h"

#include <cmath>

using namespace LAMMPS_NS;

namespace {
constexpr double OF_WORST_PACKING = 0.9;
constexpr double OF_CONTACTS = 0.8; // contacts change; and the energy error of a shear test is below 0.01 % with it
} // namespace

StepChoice::StepChoice(LAMMPS *lmp, Fix *fix) : Pointers(lmp), contacts(lmp, fix), max_step(INFINITY) {}

void StepChoice::parse(Shearbox::DeckWords &words) {
  const std::string word = words.choice();
  if (word == "check")
    rule = Rule::check;
  else if (word == "any")
    rule = Rule::any;
  else if (word == "auto")
    rule = Rule::automatic;
  else if (word == "contacts")
    rule = Rule::contacts;
  else
    error->all(FLERR, "Fix cdem/integrate: dt {}: must be check, any, auto or contacts", word);
  if (!chooses() || !words.number_follows())
    return;
  max_step = words.finite("dt");
  if (!(max_step > 0))
    error->all(FLERR, "Fix cdem/integrate: dt {} {}: the maximum must be positive", word, max_step);
}

void StepChoice::init() {
  limit = scene_minimum(cdem::step_limit);
  known = atom->natoms;
  apply();
}

bool StepChoice::sees_smaller_grains() {
  const bool came = atom->natoms > known;
  known = atom->natoms;
  const double now = came ? scene_minimum(cdem::step_limit) : limit;
  if (!(now < limit))
    return false;
  limit = now;
  if (rule != Rule::any)
    refuse_beyond_limit();
  return true;
}

double StepChoice::prediction_weight() const {
  const double dt = update->dt;
  const double least =
      scene_minimum([dt](const cdem::AmongItsLike &grain) { return cdem::prediction_weight(grain, dt); });
  return std::min(least, 1.0); // infinite without grains
}

// The smallest value over all grains, each as if surrounded by equal grains.
template <class Value> double StepChoice::scene_minimum(Value value) const {
  const auto *const pair = PairCDEM::needed_by("Fix cdem/integrate", lmp);
  const auto *grains = FixCDEMGrains::find(lmp);
  double smallest = INFINITY;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!grains->is_free(i))
      continue;
    for (int other = 1; other <= atom->ntypes; other++)
      smallest = std::min(smallest, value(pair->among_its_like(i, other)));
  }
  double all;
  MPI_Allreduce(&smallest, &all, 1, MPI_DOUBLE, MPI_MIN, world);
  return all;
}

void StepChoice::apply() {
  const bool keeps = rule == Rule::contacts && kept_step > 0;
  if (chooses())
    set_step(at_most_max(keeps ? kept_step : OF_WORST_PACKING * limit));
  check();
}

void StepChoice::check() const {
  if (!(update->dt > 0 && std::isfinite(update->dt)))
    error->all(FLERR, "Fix cdem/integrate: the time step {} must be positive", update->dt);
  if (rule == Rule::check)
    refuse_beyond_limit();
  if (chooses() && update->dt > chosen)
    error->all(FLERR, "Fix cdem/integrate: the time step {:.4g} is larger than {:.4g}, which {} has chosen", update->dt,
               chosen, rule == Rule::automatic ? "dt auto" : "dt contacts");
}

void StepChoice::refuse_beyond_limit() const {
  if (update->dt > limit)
    error->all(FLERR,
               "Fix cdem/integrate: the time step {:.4g} is beyond the stability limit {:.4g} of this scene (smallest "
               "grain, stiffest contact); take a smaller one, {}, or 'dt any' to run nevertheless",
               update->dt, limit, chooses() ? "by the MAX of dt: grains came that are smaller" : "'dt auto'");
}

double StepChoice::at_most_max(double step) const {
  step = std::min(step, max_step);
  if (!std::isfinite(step))
    error->all(FLERR, "Fix cdem/integrate: no time step: there is no grain in the group, and no MAX");
  return step;
}

void StepChoice::set_step(double step) {
  chosen = step;
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

void StepChoice::choose_by_contacts() {
  const double stable = contacts.find(limit, INFINITY);
  if (!std::isfinite(stable))
    return;
  if (comm->me == 0)
    utils::logmesg(lmp, "Fix cdem/integrate: stability limit of the contacts {:.4g} s\n", stable);
  kept_step = at_most_max(OF_CONTACTS * stable);
  set_step(kept_step);
}

// The limit of the scene assumes equal grains as neighbours: that of a large grain among many small wall discs is
// lower.
void StepChoice::compare_with_contacts() {
  if (warned)
    return;
  const double stable = contacts.find(limit, update->dt);
  warned = update->dt > stable;
  if (warned && comm->me == 0)
    error->warning(FLERR,
                   "Fix cdem/integrate: at step {} the time step {:.4g} is beyond the stability limit {:.4g} of the "
                   "present contacts: grains will not come to rest, and results are wrong",
                   update->ntimestep, update->dt, stable);
}
