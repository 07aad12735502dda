// SPDX-License-Identifier: GPL-2.0-or-later
#include "liggghts/accumulation.h"

#include "core/denormals.h"
#include "core/laws.h"
#include "core/step_events.h"
#include "liggghts/fix_integrate.h"
#include "liggghts/host.h"
#include "liggghts/styles.h"

#include "atom.h"
#include "comm.h"
#include "contact_models.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "global_properties.h"
#include "neigh_list.h"
#include "pair_gran.h"
#include "property_registry.h"
#include "settings.h"
#include "update.h"

#include <algorithm>
#include <array>
#include <map>

using namespace LAMMPS_NS;
using LIGGGHTS::ContactModels::ForceData;
using LIGGGHTS::ContactModels::SurfacesIntersectData;

namespace Liggghts {

namespace {

// LIGGGHTS packs the number of a normal model into six bits; its own end at 12. 9 means none.
constexpr int FIRST_MODEL = 50;
constexpr std::array<const char *, 2> MODELS{"direct_accumulation", "incremental_accumulation"};
constexpr int TOUCHES = LIGGGHTS::ContactModels::CONTACT_NORMAL_MODEL; // flag of a contact whose history is kept

std::map<LAMMPS *, Accumulation *> &in_use() {
  static std::map<LAMMPS *, Accumulation *> models;
  return models;
}

template <int accumulation> LIGGGHTS::PairStyles::IGranularPairStyle *create(LAMMPS *lmp, PairGran *, std::int64_t) {
  add_styles(lmp);
  return new Accumulation(lmp, accumulation);
}

MatrixProperty *create_hn(PropertyRegistry &registry, const char *caller, bool) {
  return MODEL_PARAMS::createPerTypePairProperty(registry, "hn", caller, true, 0.0);
}
MatrixProperty *create_hs(PropertyRegistry &registry, const char *caller, bool) {
  return MODEL_PARAMS::createPerTypePairProperty(registry, "hs", caller, true, 0.0);
}

} // namespace

void Accumulation::register_models() {
  auto &names = LIGGGHTS::ContactModels::Factory::instance();
  auto &styles = LIGGGHTS::PairStyles::Factory::instance();
  for (std::size_t k = 0; k < MODELS.size(); k++)
    names.addNormalModel(MODELS[k], FIRST_MODEL + int(k));
  styles.addStyle("gran", FIRST_MODEL, create<0>);
  styles.addStyle("gran", FIRST_MODEL + 1, create<1>);
}

Accumulation &Accumulation::needed_by(const std::string &who, LAMMPS *lmp) {
  const auto found = in_use().find(lmp);
  if (found == in_use().end())
    stop(lmp, who, " needs pair_style gran model ", MODELS[0], " or ", MODELS[1]);
  return *found->second;
}

Accumulation::Accumulation(LAMMPS *lmp, int accumulation) : Pointers(lmp), accumulation(accumulation) {
  in_use()[lmp] = this;
}

Accumulation::~Accumulation() { in_use().erase(lmp); }

int64_t Accumulation::hashcode() { return FIRST_MODEL + accumulation; }

bool Accumulation::contact_match(const std::string type, const std::string model) {
  return type == "normal" && model == MODELS[accumulation];
}

void Accumulation::settings(int narg, char **arg, LIGGGHTS::IContactHistorySetup *history) {
  Settings settings(lmp);
  settings.registerOnOff("limit_damping", limit_damping, false);
  if (!settings.parseArguments(narg, arg))
    stop(lmp, "Pair gran model ", MODELS[accumulation], ": ", settings.error_message);
  // The springs do not change their signs with the order of the discs.
  es = history->add_history_value("es", "0");
  if (accumulation == 1)
    en = history->add_history_value("en", "0");
}

int Accumulation::get_history_offset(const std::string name) {
  return name == "es" ? es : name == "en" && accumulation == 1 ? en : -1;
}

// As LIGGGHTS's own models do; a deck names the model again after read_restart, with its settings.
void Accumulation::write_restart_settings(FILE *file) {
  const std::int64_t code = hashcode();
  std::fwrite(&code, sizeof code, 1, file);
}

void Accumulation::read_restart_settings(FILE *file, std::int64_t) {
  std::int64_t code;
  if (comm->me == 0 && (std::fread(&code, sizeof code, 1, file) != 1 || code != hashcode()))
    error->one(FLERR, "Pair gran: the restart file is of another contact model");
}

void Accumulation::check() const {
  const std::string who = std::string("Pair gran model ") + MODELS[accumulation];
  if (domain->dimension != 2)
    stop(lmp, who, ": dimension is ", domain->dimension, ", must be 2");
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag)
    stop(lmp, who, " needs atom_style sphere");
  if (force->newton_pair)
    stop(lmp, who, " needs newton off");
  auto *pair = dynamic_cast<PairGran *>(force->pair);
  if (pair && pair->fr_pair())
    stop(lmp, who, ": grains are single discs, fix rigid is not possible");
  if (pair && (pair->storeContactForces() || pair->storeContactForcesStress() || pair->storeSumDelta()))
    stop(lmp, who, ": a fix or compute has contact forces stored, which is not possible");
}

void Accumulation::init_granular() {
  cdem::keep_denormals();
  check();
  const char *const who = MODELS[accumulation];
  PropertyRegistry &registry = force->registry;
  registry.registerProperty("k_n", &MODEL_PARAMS::createKn);
  registry.registerProperty("k_t", &MODEL_PARAMS::createKt);
  registry.registerProperty("hn", &create_hn);
  registry.registerProperty("hs", &create_hs);
  registry.registerProperty("coeffFrict", &MODEL_PARAMS::createCoeffFrict);
  registry.connect("k_n", kn, who);
  registry.connect("k_t", kt, who);
  registry.connect("hn", hn, who);
  registry.connect("hs", hs, who);
  registry.connect("coeffFrict", mu, who);

  stride = registry.max_type() + 1;
  materials.assign(stride * stride, {});
  for (int i = 1; i < stride; i++)
    for (int j = 1; j < stride; j++) {
      if (!(kn[i][j] > 0 && kt[i][j] >= 0 && mu[i][j] >= 0))
        stop(lmp, "Pair gran model ", who, ": kn ", kn[i][j], " must be positive, kt ", kt[i][j],
             " and the coefficient of friction ", mu[i][j], " 0 or more, for types ", i, " ", j);
      materials[i * stride + j] = cdem::material(kn[i][j], kt[i][j], hn[i][j], hs[i][j], mu[i][j]);
    }
  motion = find_fix<FixIntegrate>(lmp);
  if (!motion)
    stop(lmp, "Pair gran model ", who, " needs fix cdem/integrate");
}

void Accumulation::compute_force(PairGran *pair, int eflag, int vflag, int addflag) {
  if (eflag || vflag)
    pair->ev_setup(eflag, vflag);
  else
    pair->evflag = pair->vflag_fdotr = 0;
  cdem::with_law<1>({accumulation, 0, limit_damping, false}, [&](auto law) { forces<decltype(law)>(pair, addflag); });
}

namespace {

// A pair of discs as the computes of LIGGGHTS want it.
void tell_computes(PairGran *pair, const Atom &atom, int i, int j, double *history, const cdem::Forces<double> &f) {
  SurfacesIntersectData contact{};
  contact.i = i, contact.j = j;
  for (int k = 0; k < 2; k++)
    contact.delta[k] = atom.x[i][k] - atom.x[j][k];
  contact.rsq = contact.delta[0] * contact.delta[0] + contact.delta[1] * contact.delta[1];
  contact.r = std::sqrt(contact.rsq), contact.rinv = 1 / contact.r;
  for (int k = 0; k < 2; k++)
    contact.en[k] = contact.delta[k] * contact.rinv;
  contact.radi = atom.radius[i], contact.radj = atom.radius[j];
  contact.radsum = contact.radi + contact.radj;
  contact.deltan = contact.radsum - contact.r;
  contact.contact_history = history;
  ForceData force;
  force.delta_F[0] = f.fx, force.delta_F[1] = f.fy, force.delta_torque[2] = f.torque_a;
  pair->cpl_add_pair(contact, force);
}

struct Stored {
  double normal, tangential, added;
};

// Energy in the springs of a contact (J); `numbers`: what it remembers.
template <class Law> double stored(const cdem::Material &m, double overlap, const double *numbers, int es, int en) {
  const double remembered[2] = {numbers[es], numbers[en]};
  const auto e = Law::template energy<Stored>(m, nullptr, remembered, overlap);
  return e.normal + e.tangential;
}

} // namespace

// Of the pair of i and j, on i. The disc of the lower id is the first of a pair, so that both ranks which see a pair
// compute the same. `numbers`: what the contact remembers, kept if `keeps`.
template <class Law>
cdem::Forces<double> Accumulation::force_of_pair(int i, int j, double dt, double of_steps, double *numbers,
                                                 bool keeps) const {
  const double *const radius = atom->radius, *const rmass = atom->rmass;
  const bool first = atom->tag[i] < atom->tag[j];
  const int a = first ? i : j, b = first ? j : i;
  const double m = motion->is_wall(i) ? rmass[j] : motion->is_wall(j) ? rmass[i] : cdem::reduced(rmass[i], rmass[j]);
  const cdem::PairConstants<double> constants{radius[i] + radius[j], 0.5 * (radius[a] - radius[b]),
                                              cdem::dashpot_scale(m, of_steps)};
  const auto u = cdem::relative(motion->disc(a), motion->disc(b));
  double spring = numbers[es];
  std::array<double, Law::MEMORIES> memory{};
  if constexpr (Law::MEMORIES > 0)
    memory[0] = numbers[en];
  cdem::NoLosses books;
  const cdem::Forces<double> on_a = Law::force(u, cdem::distance_of(u), constants, {},
                                               material(atom->type[i], atom->type[j]), dt, spring, memory, books);
  if (keeps) {
    numbers[es] = spring;
    if constexpr (Law::MEMORIES > 0)
      numbers[en] = memory[0];
  }
  return first ? on_a : cdem::opposite(on_a);
}

template <class Law> void Accumulation::forces(PairGran *pair, bool add_to_computes) {
  const bool acts = pair->computeflag(), tells = pair->cpl() && add_to_computes, tallies = pair->evflag;
  const double dt = acts && pair->shearupdate() ? update->dt : 0;
  const NeighList &list = *pair->list, &histories = *pair->listgranhistory;
  const int nlocal = atom->nlocal, remembered = pair->dnum();
  double *const *const x = atom->x, *const *const f = atom->f, *const *const torque = atom->torque;
  std::vector<double> of_steps(materials.size());
  for (std::size_t k = 0; k < materials.size(); k++)
    of_steps[k] = cdem::mass_of_steps(materials[k], update->dt, motion->prediction_weight());

  for (int ii = 0; ii < list.inum; ii++) {
    const int i = list.ilist[ii];
    int *const flags = histories.firstneigh[i];
    double fx = 0, fy = 0, turn = 0;
    for (int jj = 0; jj < list.numneigh[i]; jj++) {
      const int j = list.firstneigh[i][jj] & NEIGHMASK;
      const double dx = x[i][0] - x[j][0], dy = x[i][1] - x[j][1], radii = atom->radius[i] + atom->radius[j];
      if ((dx * dx + dy * dy >= radii * radii && !flags[jj]) || (motion->is_wall(i) && motion->is_wall(j)))
        continue;
      const int types = atom->type[i] * stride + atom->type[j];
      double *const numbers = histories.firstdouble[i] + jj * remembered;
      const cdem::Forces<double> on_i = force_of_pair<Law>(i, j, dt, of_steps[types], numbers, acts);
      if (acts) {
        flags[jj] = cdem::touched(numbers[es]) ? TOUCHES : 0;
        fx += on_i.fx, fy += on_i.fy, turn += on_i.torque_a;
        if (j < nlocal)
          f[j][0] -= on_i.fx, f[j][1] -= on_i.fy, torque[j][2] += on_i.torque_b;
      }
      if (tells)
        tell_computes(pair, *atom, i, j, numbers, on_i);
      if (tallies)
        pair->ev_tally_xyz(i, j, nlocal, 0, stored<Law>(materials[types], radii - std::hypot(dx, dy), numbers, es, en),
                           0, on_i.fx, on_i.fy, 0, dx, dy, 0);
    }
    f[i][0] += fx, f[i][1] += fy, torque[i][2] += turn;
  }
  if (tells)
    pair->cpl_pair_finalize();
}

// A contact across a border between ranks is seen from both sides: each gives half of it.
Accumulation::Sums Accumulation::sums() const {
  const auto *const pair = dynamic_cast<const PairGran *>(force->pair);
  const NeighList &list = *pair->list, &histories = *pair->listgranhistory;
  const int remembered = const_cast<PairGran *>(pair)->dnum();
  cdem::ExactSum contacts, normal, energy;
  cdem::with_law<1>({accumulation, 0, limit_damping, false}, [&](auto law) {
    using Law = decltype(law);
    for (int ii = 0; ii < list.inum; ii++)
      for (int i = list.ilist[ii], jj = 0; jj < list.numneigh[i]; jj++) {
        const int j = list.firstneigh[i][jj] & NEIGHMASK;
        const double distance = std::hypot(atom->x[i][0] - atom->x[j][0], atom->x[i][1] - atom->x[j][1]);
        const double overlap = atom->radius[i] + atom->radius[j] - distance, share = j < atom->nlocal ? 1 : 0.5;
        if (overlap <= 0 || (motion->is_wall(i) && motion->is_wall(j)))
          continue;
        const double *const numbers = histories.firstdouble[i] + jj * remembered;
        const cdem::Material &m = material(atom->type[i], atom->type[j]);
        contacts.add(share);
        normal.add(share * (Law::MEMORIES > 0 ? numbers[en] : m.kn * overlap));
        energy.add(share * stored<Law>(m, overlap, numbers, es, en));
      }
  });
  return {over_ranks(lmp, contacts), over_ranks(lmp, normal), over_ranks(lmp, energy)};
}

} // namespace Liggghts
