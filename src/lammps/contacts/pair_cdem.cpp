// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/pair_cdem.h"

#include "core/list_skin.h"
#include "grains/fix_cdem_audit.h"
#include "grains/fix_cdem_grains.h"
#include "host/compat.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "timer.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

using namespace LAMMPS_NS;

namespace {
constexpr double DEGREE = M_PI / 180;
}

PairCDEM::PairCDEM(LAMMPS *lmp) : Pair(lmp), rows(lmp) {
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
  materials.assign(n + 1, std::vector<cdem::Material>(n + 1));
}

void PairCDEM::settings(int narg, char **arg) {
  bool law_given = false;
  instructions = cdem::instruction_sets().front();
  for (int k = 0; k < narg; k += 2) {
    const std::string key = arg[k], value = k + 1 < narg ? arg[k + 1] : "nothing";
    if (key == "law") {
      if (value == "direct")
        law = cdem::Law::direct;
      else if (value == "incremental")
        law = cdem::Law::incremental;
      else
        error->all(FLERR, "Pair style cdem: law {}: must be direct or incremental", value);
      law_given = true;
    } else if (key == "limit_damping") {
      if (value != "yes" && value != "no")
        error->all(FLERR, "Pair style cdem: limit_damping {}: must be yes or no", value);
      limit_damping = value == "yes";
    } else if (key == "instructions") {
      const std::vector<std::string> known = cdem::instruction_sets();
      if (std::find(known.begin(), known.end(), value) == known.end())
        error->all(FLERR, "Pair style cdem: instructions {}: this machine has {}", value,
                   fmt::format("{}", fmt::join(known, ", ")));
      instructions = value;
    } else {
      error->all(FLERR, "Pair style cdem: unknown keyword {}; allowed: law, limit_damping, instructions", key);
    }
  }
  if (!law_given)
    error->all(FLERR, "Pair style cdem: 'law direct' or 'law incremental' must be given");
}

void PairCDEM::coeff(int narg, char **arg) {
  if (narg != 7)
    error->all(FLERR, "Pair coeff cdem has {} arguments; needed: I J kn ks hn hs phi", narg);
  if (!allocated)
    allocate();

  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);

  static const char *const names[] = {"kn", "ks", "hn", "hs", "phi"};
  double value[5];
  for (int k = 0; k < 5; k++) {
    value[k] = utils::numeric(FLERR, arg[k + 2], false, lmp);
    if (!std::isfinite(value[k]) || value[k] < 0)
      error->all(FLERR, "Pair coeff cdem: {} = {} must be a number, not negative", names[k], arg[k + 2]);
  }
  if (value[0] == 0)
    error->all(FLERR, "Pair coeff cdem: kn = 0 must be positive");
  if (value[4] >= 90)
    error->all(FLERR, "Pair coeff cdem: phi = {} degrees must be below 90", value[4]);

  const cdem::Material m = cdem::material(value[0], value[1], value[2], value[3], std::tan(value[4] * DEGREE));
  int count = 0;
  for (int i = ilo; i <= ihi; i++)
    for (int j = std::max(jlo, i); j <= jhi; j++) {
      materials[i][j] = materials[j][i] = m;
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
  if (!atom->sphere_flag)
    error->all(FLERR, "Pair style cdem needs atom_style sphere");
  if (strcmp(atom->atom_style, "sphere") == 0 && !atom->avec->comm_x_only) // that is how it shows
    error->all(FLERR, "Pair style cdem: atom_style sphere 1 must be sphere or sphere 0: radii cannot change in a run");
  if (!atom->tag_enable)
    error->all(FLERR, "Pair style cdem: atom_modify id no must be yes: contacts are remembered by the ids of grains");
  if (!comm->ghost_velocity)
    error->all(FLERR, "Pair style cdem needs 'comm_modify vel yes'");
  if (!grains || !grains->are_moved())
    error->all(FLERR, "Pair style cdem needs a fix cdem/integrate: atoms outside its group are walls");
  if (update->whichflag == 2)
    error->all(FLERR, "Pair style cdem: minimize has no steps of time to follow the contacts in; use run, with drag");
  if (!(neighbor->skin > 0))
    error->all(FLERR,
               "Pair style cdem: the skin of the neighbour list is {}, must be positive: a contact acts on in the "
               "step in which it opens",
               neighbor->skin);
}

void PairCDEM::check_atoms() const {
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->radius[i] > 0))
      error->one(FLERR, "Pair style cdem: atom {} has radius {}, must be positive", atom->tag[i], atom->radius[i]);
    if (!(atom->rmass[i] > 0))
      error->one(FLERR, "Pair style cdem: atom {} has mass {}, must be positive", atom->tag[i], atom->rmass[i]);
    if (atom->x[i][2] != 0)
      error->one(FLERR, "Pair style cdem: atom {} is at z = {}, must be 0: LAMMPS takes distances in space",
                 atom->tag[i], atom->x[i][2]);
  }
}

void PairCDEM::init_style() {
  grains = FixCDEMGrains::find(lmp);
  audit = FixCDEMAudit::find(lmp);
  check_setting();
  check_atoms();
  rows.init(grains, cdem::kernels({law, limit_damping}, instructions));
  list_speed = -1;
  list_of_run = false;
  Shearbox::request_half_size_list(lmp, this, instance_me);

  if (!history)
    history = static_cast<FixCDEMHistory *>(modify->add_fix(std::string(FixCDEMHistory::ID) + " all cdem/history"));
  history->list = this;

  std::vector<double> mine(atom->ntypes + 1, 0.0);
  for (int i = 0; i < atom->nlocal; i++)
    mine[atom->type[i]] = std::max(mine[atom->type[i]], atom->radius[i]);
  largest_radius.resize(mine.size());
  MPI_Allreduce(mine.data(), largest_radius.data(), int(mine.size()), MPI_DOUBLE, MPI_MAX, world);
  check_periods();
}

// Two grains have one history for each pair of their discs, so they may not touch on both sides of a period.
void PairCDEM::check_periods() const {
  const double needed = 4 * *std::max_element(largest_radius.begin(), largest_radius.end());
  for (int k = 0; k < 2; k++)
    if (domain->periodicity[k] && domain->prd[k] < needed)
      error->all(FLERR,
                 "Pair style cdem: the box is periodic over {} m in {}, must be {} m or more (two diameters of the "
                 "largest grain): two grains would touch on both sides",
                 domain->prd[k], k ? "y" : "x", needed);
}

double PairCDEM::init_one(int i, int j) {
  if (!setflag[i][j])
    error->all(FLERR, "Pair style cdem: no pair_coeff for types {} and {}", i, j);
  return largest_radius[i] + largest_radius[j];
}

void PairCDEM::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  const bool rebuilt = neighbor->ago == 0;
  if (rebuilt)
    rows.map();

  // During a step, v and omega are those of the half step; at setup they are those of the full step.
  rows.fill(0, atom->nlocal, update->setupflag ? 0 : grains->step_rule().forward);
  exchange_ghosts();
  if (rebuilt) {
    neighbours_built_at.resize(atom->nlocal);
    for (int i = 0; i < atom->nlocal; i++)
      neighbours_built_at[i] = {atom->x[i][0], atom->x[i][1]};
    build_list();
  } else {
    refresh_list(list_room);
  }
  forces();
  if (evflag)
    tally();
}

void PairCDEM::exchange_ghosts() {
  if (atom->nghost || comm->nprocs > 1)
    Shearbox::forward_comm(lmp, this);
  rows.expand_ghosts();
}

int PairCDEM::pack_forward_comm(int n, int *list, double *buf, int pbc_flag, int *pbc) {
  return rows.pack(n, list, buf, pbc_flag, pbc);
}

void PairCDEM::unpack_forward_comm(int n, int first, double *buf) { rows.unpack(n, first, buf); }

void PairCDEM::pair_forces(int block) {
  history_in_list = true;
  const double dt = update->setupflag ? 0 : update->dt;
  cdem::PairColumns columns = pairs.columns(slots.data());
  if (fetches_ahead)
    columns.ahead = {rows.discs() + slots.read_end(block), rows.body(block_starts[block])};
  for (int k = pairs.first_segment[block]; k < pairs.first_segment[block + 1]; k++) {
    const auto &segment = pairs.segments[k];
    kernels.forces(rows.discs(), columns, segment.material, segment.begin, segment.end, dt);
  }
}

void PairCDEM::forces() {
  for (int block = 0; block < slots.blocks(); block++) {
    const int begin = block_starts[block], end = block_starts[block + 1];
    pair_forces(block);
    keep_forces(block);
    rows.sum_block(slots.block(block), begin, end);
    for (int i = begin; i < end; i++) {
      const auto [fx, fy, torque] = rows.force_on(i);
      atom->f[i][0] += fx;
      atom->f[i][1] += fy;
      atom->torque[i][2] += torque;
    }
  }
}

// For all that looks at single contacts.
void PairCDEM::keep_forces(int block) {
  for (int s = pairs.first_segment[block]; s < pairs.first_segment[block + 1]; s++)
    for (int k = pairs.segments[s].begin; k < pairs.segments[s].end; k++)
      pairs.force[k] = slots.of_pair(pairs, k);
}

// A pair belongs to the block of its lower row. So once the pairs of a block are done, so are all pairs of its grains,
// and these can be moved while their forces are still in the cache: later blocks don't look at them.
void PairCDEM::forces_and_advance(const cdem::StepRule &step, const std::vector<int> &felt, cdem::Fastest &fastest,
                                  cdem::Travel *travel) {
  auto wall = felt.begin();
  for (int block = 0; block < slots.blocks(); block++) {
    const int begin = block_starts[block], end = block_starts[block + 1];
    pair_forces(block);
    for (; wall != felt.end() && *wall < end; ++wall) {
      rows.sum_grain(slots, *wall);
      const auto [fx, fy, torque] = rows.force_on(*wall);
      atom->f[*wall][0] = fx;
      atom->f[*wall][1] = fy;
    }
    rows.advance(slots.block(block), begin, end, step, fastest, travel);
  }
}

double PairCDEM::Place::moved(const cdem::Disc<double> &now) const {
  const double dx = now.x - x, dy = now.y - y;
  return std::sqrt(dx * dx + dy * dy);
}

double PairCDEM::room() const {
  double most = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    const double moved = neighbours_built_at[i].moved(rows.of_grain(i));
    if (!std::isfinite(moved))
      return -INFINITY; // before the list is rebuilt, the guard says which atom it is
    most = std::max(most, moved);
  }
  return 0.5 * neighbor->skin - most;
}

// How far any point of a grain is from where it was when the list of disc pairs was built.
double PairCDEM::most_moved() const {
  double most = 0;
  for (std::size_t i = 0; i < discs_built_at.size(); i++) {
    double moved = discs_built_at[i].moved(rows.of_grain(i));
    if (rows.has_clumps())
      moved += rows.reach(i) * std::fabs(rows.angle(i) - angle_built_at[i]);
    most = std::max(most, moved);
  }
  return most;
}

// Only when a bound of the motion is used up is the motion itself looked at.
void PairCDEM::refresh_list(double moved) {
  constexpr double LEAST = 0.05; // of the skin: with less left it is not worth keeping
  list_room -= moved;
  if (list_room > 0)
    return;
  list_room = 0.5 * list_skin - most_moved();
  if (list_room > LEAST * list_skin)
    return;
  timer->stamp(Timer::PAIR);
  list_speed = (0.5 * list_skin - list_room) / double(std::max<bigint>(update->ntimestep - list_step, 1));
  finish_step_in_books();
  copy_history_to_grains();
  build_list();
  timer->stamp(Timer::NEIGH);
}

double PairCDEM::largest_reach() const {
  double reach = 0;
  if (rows.has_clumps())
    for (int i = 0; i < atom->nlocal; i++)
      reach = std::max(reach, rows.reach(i));
  return reach;
}

void PairCDEM::build_list() {
  booking = audit != nullptr;
  list_of_run = true;
  kernels = cdem::kernels({law, limit_damping, booking}, instructions);
  choose_skin();
  listed.assign(atom->tag, atom->tag + atom->nlocal + atom->nghost);
  divide_into_blocks();
  find_pairs();
  set_constants();
  pairs.for_each([this](int k, const cdem::Material &) { recall_history(k); });
  std::vector<int> row_starts;
  for (int grain : block_starts)
    row_starts.push_back(rows.rows_of(grain));
  slots.build(
      // The order of all sums: by the id of the grain, then by the disc.
      pairs, row_starts, [this](int p) { return std::pair(atom->tag[rows.grain(p)], rows.disc(p)); },
      [this](int p) { return !grains->is_free(rows.grain(p)); });
  history->expect_at_most(most_pairs());
  constexpr double SECOND_CACHE = 2e6; // of a core, bytes
  fetches_ahead = pairs.bytes() + rows.bytes() + slots.bytes() > SECOND_CACHE;

  discs_built_at.resize(atom->nlocal + atom->nghost);
  angle_built_at.resize(rows.has_clumps() ? discs_built_at.size() : 0);
  for (std::size_t i = 0; i < discs_built_at.size(); i++)
    discs_built_at[i] = {rows.of_grain(i).x, rows.of_grain(i).y};
  for (std::size_t i = 0; i < angle_built_at.size(); i++)
    angle_built_at[i] = rows.angle(i);
  list_room = 0.5 * list_skin;
  list_step = update->ntimestep;
}

// Of any own grain.
int PairCDEM::most_pairs() const {
  int most = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    int n = 0;
    for (int p = rows.rows_of(i); p < rows.rows_of(i + 1); p++)
      n += slots.pairs_of(p);
    most = std::max(most, n);
  }
  return most;
}

// The skin of the list of disc pairs that costs least, see core/list_skin.h. A pair that opens in this step must stay
// for another one: its forces may have a share left. The bits of the forces don't depend on the skin.
void PairCDEM::choose_skin() {
  constexpr double LEAST = 0.01, SAFETY = 8;
  constexpr int LOOKED_AT = 256; // grains, whose neighbours tell enough
  const double largest = neighbor->skin;
  const double step = update->dt * rows.fastest(atom->nlocal + atom->nghost).speed(largest_reach());
  const int every = std::max(1, list->inum / LOOKED_AT);
  double touching = 0, near = 0;
  list_skin = largest;
  for (int ii = 0; ii < list->inum; ii += every)
    for_each_candidate(list->ilist[ii], [&](int p, int q, double square) {
      (std::sqrt(square) < rows.radius(p) + rows.radius(q) ? touching : near) += every;
    });
  const double cheapest =
      cdem::cheapest_skin(rows.rows_of(atom->nlocal), touching, near / largest, list_speed < 0 ? step : list_speed);
  list_skin = std::min(std::max({cheapest, LEAST * largest, SAFETY * step}), largest);
}

// Small enough that a block's forces stay in the cache.
void PairCDEM::divide_into_blocks() {
  constexpr int ROWS = 512;
  block_starts.assign(1, 0);
  for (int i = 1; i < atom->nlocal; i++)
    if (rows.rows_of(i + 1) - rows.rows_of(block_starts.back()) > ROWS)
      block_starts.push_back(i);
  block_starts.push_back(atom->nlocal);
}

// Calls visit(row, row, square of their distance) for all pairs of discs that may touch before the next rebuild, of
// grain i and those that LAMMPS lists as its neighbours.
template <class Visit> void PairCDEM::for_each_candidate(int i, Visit visit) const {
  for (int jj = 0; jj < list->numneigh[i]; jj++) {
    const int j = list->firstneigh[i][jj] & NEIGHMASK;
    if (!grains->is_free(i) && !grains->is_free(j))
      continue;
    for (int p = rows.rows_of(i); p < rows.rows_of(i + 1); p++)
      for (int q = rows.rows_of(j); q < rows.rows_of(j + 1); q++) {
        const double dx = rows[p].x - rows[q].x, dy = rows[p].y - rows[q].y, square = dx * dx + dy * dy;
        const double reach = rows.radius(p) + rows.radius(q) + list_skin;
        if (square < reach * reach)
          visit(p, q, square);
      }
  }
}

// Segments are by block, then by material.
void PairCDEM::find_pairs() {
  const int types = atom->ntypes + 1;
  std::vector<cdem::Material> by_types;
  for (const auto &row : materials)
    by_types.insert(by_types.end(), row.begin(), row.end());
  int lower = -1, block = 0; // the last one's
  auto segment_of = [&](int i, int j) {
    if (std::min(i, j) != lower)
      block = cdem::block_of(block_starts, lower = std::min(i, j));
    const auto [low, high] = std::minmax(atom->type[i], atom->type[j]);
    return (block * types + low) * types + high;
  };

  std::vector<int> sizes(by_types.size() * (block_starts.size() - 1), 0), next(sizes.size(), 0);
  found.clear();
  for (int ii = 0; ii < list->inum; ii++)
    for_each_candidate(list->ilist[ii], [&](int p, int q, double square) {
      const int i = rows.grain(p), j = rows.grain(q), segment = segment_of(i, j);
      if (square == 0)
        refuse_same_centre(p, q);
      const bool p_first = atom->tag[i] < atom->tag[j];
      found.push_back({p_first ? p : q, p_first ? q : p, segment});
      sizes[segment]++;
    });
  pairs.lay_out(by_types, sizes, law, booking);
  auto segment = pairs.segments.begin();
  for (std::size_t m = 0; m < sizes.size(); m++)
    if (sizes[m])
      next[m] = (segment++)->begin;
  for (const auto &[p, q, segment] : found)
    pairs.set_discs(next[segment]++, p, q);
}

void PairCDEM::refuse_same_centre(int p, int q) const {
  error->one(FLERR,
             "Pair style cdem: discs of atoms {} and {} have the same centre ({}, {}): no direction to push them apart",
             atom->tag[rows.grain(p)], atom->tag[rows.grain(q)], rows[p].x, rows[p].y);
}

void PairCDEM::set_constants() {
  const cdem::StepRule step = grains->step_rule();
  for (const auto &[material, begin, end] : pairs.segments) {
    const double of_steps = cdem::mass_of_steps(material, step.dt, 2 * step.forward / step.dt);
    for (int k = begin; k < end; k++) {
      const double rp = rows.radius(pairs.a(k)), rq = rows.radius(pairs.b(k));
      pairs.set_constants(k, {rp + rq, 0.5 * (rp - rq), cdem::root_mass(mass(k), of_steps)});
    }
  }
}

void PairCDEM::renew_constants() {
  const bool running = update->whichflag != 0; // else atoms may have come and gone since the list was built
  if (running && list_of_run)
    set_constants();
}

double PairCDEM::mass(int k) const {
  const int i = rows.grain(pairs.a(k)), j = rows.grain(pairs.b(k));
  const double mi = atom->rmass[i], mj = atom->rmass[j];
  return !grains->is_free(j) ? mi : !grains->is_free(i) ? mj : mi * mj / (mi + mj);
}

void PairCDEM::recall_history(int k) {
  const int i = rows.grain(pairs.a(k)), j = rows.grain(pairs.b(k)), p = rows.disc(pairs.a(k)),
            q = rows.disc(pairs.b(k));
  const FixCDEMHistory::Contact *const known =
      i < atom->nlocal ? history->find_contact(i, atom->tag[j], p, q) : history->find_contact(j, atom->tag[i], q, p);
  pairs.set_es(k, known ? known->es : 0);
  if (law == cdem::Law::incremental)
    pairs.en[k] = known ? known->en : 0;
}

// Energy and virial, with the branch vector from grain centre to grain centre.
void PairCDEM::tally() {
  pairs.for_each([this](int k, const cdem::Material &m) {
    if (!acts(k))
      return;
    const int i = rows.grain(pairs.a(k)), j = rows.grain(pairs.b(k));
    const double *const xi = atom->x[i], *const xj = atom->x[j];
    const auto [normal, tangential] = eflag_either ? spring_energy(k, m) : SpringEnergy{0, 0};
    const auto [fx, fy] = pairs.force[k];
    ev_tally_xyz(i, j, atom->nlocal, force->newton_pair, normal + tangential, 0, fx, fy, 0, xi[0] - xj[0],
                 xi[1] - xj[1], 0);
  });
}

double PairCDEM::overlap(int k) const {
  const auto &a = rows[pairs.a(k)], &b = rows[pairs.b(k)];
  return pairs.constants(k).radius_sum - std::hypot(a.x - b.x, a.y - b.y);
}

// A pair across a border is on two ranks (or twice on one, if periodic): the owner of disc a counts it.
bool PairCDEM::counts(int k) const { return rows.grain(pairs.a(k)) < block_starts.back(); }

// Also in the step after it opened, in which its forces may have a share left.
bool PairCDEM::acts(int k) const {
  const auto [fx, fy] = pairs.force[k];
  return overlap(k) > 0 || fx != 0 || fy != 0;
}

PairCDEM::SpringEnergy PairCDEM::spring_energy(int k, const cdem::Material &m) const {
  if (overlap(k) <= 0)
    return {0, 0};
  const double en = law == cdem::Law::direct ? m.kn * overlap(k) : pairs.en[k], es = pairs.es(k);
  return {0.5 * en * en / m.kn, m.ks > 0 ? 0.5 * es * es / m.ks : 0};
}

PairCDEM::SpringEnergy PairCDEM::spring_energy() const {
  SpringEnergy sum{0, 0};
  pairs.for_each([&](int k, const cdem::Material &m) {
    if (!counts(k))
      return;
    const auto [normal, tangential] = spring_energy(k, m);
    sum.normal += normal;
    sum.tangential += tangential;
  });
  return sum;
}

void PairCDEM::close_list() {
  if (audit && history_in_list) {
    rows.fill(0, atom->nlocal, 0);
    exchange_ghosts();
    finish_step_in_books();
  }
  move_history_to_grains();
}

// The rows have moved, and a new list won't know the last forces of the dashpots. Half of them acted in this step; the
// other half is that of forces which are still to be computed: for now, of a contact without any.
void PairCDEM::finish_step_in_books() {
  if (pairs.friction.empty())
    return;
  pairs.for_each([this](int k, const cdem::Material &) {
    const auto relative = cdem::relative(rows[pairs.a(k)], rows[pairs.b(k)]);
    cdem::History<double> none{0, 0};
    cdem::Losses<double> losses{0, pairs.dashpots[k], pairs.dashpot_n[k], pairs.dashpot_t[k]};
    cdem::contact_force<cdem::Law::direct, false>(relative, cdem::distance_of(relative), pairs.constants(k), {},
                                                  update->dt, none, losses);
    pairs.dashpots[k] = losses.dashpots;
    pairs.dashpot_n[k] = pairs.dashpot_t[k] = 0;
  });
}

void PairCDEM::book_losses() {
  if (!audit || pairs.friction.empty())
    return;
  pairs.for_each([this](int k, const cdem::Material &) {
    if (counts(k)) {
      audit->books.friction += pairs.friction[k];
      audit->books.dashpots += pairs.dashpots[k];
    }
    pairs.friction[k] = pairs.dashpots[k] = 0;
  });
}

PairCDEM::Contact PairCDEM::contact(int k) const {
  const int p = pairs.a(k), q = pairs.b(k);
  const double dx = rows[p].x - rows[q].x, dy = rows[p].y - rows[q].y, distance = std::hypot(dx, dy);
  const auto [fx, fy] = pairs.force[k];

  Contact c;
  c.tag_a = atom->tag[rows.grain(p)];
  c.tag_b = atom->tag[rows.grain(q)];
  c.disc_a = rows.disc(p);
  c.disc_b = rows.disc(q);
  c.nx = dx / distance;
  c.ny = dy / distance;
  const double lever = 0.5 * distance + pairs.constants(k).half_difference;
  c.x = rows[p].x - lever * c.nx;
  c.y = rows[p].y - lever * c.ny;
  c.fn = fx * c.nx + fy * c.ny;
  c.ft = fy * c.nx - fx * c.ny;
  c.overlap = overlap(k);
  c.sliding = !cdem::is_marked(pairs.es(k));
  c.mine = counts(k);
  return c;
}

std::vector<PairCDEM::Contact> PairCDEM::contacts() const {
  std::vector<Contact> all;
  pairs.for_each([&](int k, const cdem::Material &) {
    if (acts(k))
      all.push_back(contact(k));
  });
  return all;
}

std::vector<PairCDEM::DiscPlace> PairCDEM::discs() const {
  std::vector<DiscPlace> all;
  for (int p = 0; p < rows.rows_of(atom->nlocal); p++)
    all.push_back({rows.grain(p), rows.disc(p), rows[p].x, rows[p].y, rows.radius(p)});
  return all;
}

double PairCDEM::single(int i, int j, int itype, int jtype, double, double, double, double &fforce) {
  double energy = 0;
  fforce = 0;
  std::fill_n(svector, single_extra, 0.0);
  if (i >= atom->nlocal)
    std::swap(i, j);
  auto add = [&](int k) {
    const int p = pairs.a(k), q = pairs.b(k), other = rows.grain(p) == i ? rows.grain(q) : rows.grain(p);
    if (atom->tag[other] != atom->tag[j] || !acts(k))
      return;
    const Contact c = contact(k);
    const auto [normal, tangential] = spring_energy(k, materials[itype][jtype]);
    energy += normal + tangential;
    fforce += c.fn / std::hypot(rows[p].x - rows[q].x, rows[p].y - rows[q].y);
    svector[0] += c.fn;
    svector[1] += c.ft;
    svector[2] += pairs.es(k);
  };
  for (int p = rows.rows_of(i); p < rows.rows_of(i + 1); p++)
    slots.for_each(p, add);
  return energy;
}

// Grains may have come and gone since the list was built: only what was noted then is of use here.
void PairCDEM::copy_history_to_grains() {
  if (!history_in_list)
    return;
  book_losses();
  const int own_grains = block_starts.back();
  auto for_each_memory = [&](auto visit) { // visit(grain, contact as it remembers it)
    pairs.for_each([&](int k, const cdem::Material &) {
      const double es = pairs.es(k), en = law == cdem::Law::incremental ? pairs.en[k] : 0;
      if (es == 0 && en == 0)
        return;
      const int a = pairs.a(k), b = pairs.b(k);
      for (const auto &[own, other] : {std::pair{a, b}, std::pair{b, a}})
        if (rows.grain(own) < own_grains)
          visit(rows.grain(own), FixCDEMHistory::Contact{listed[rows.grain(other)], short(rows.disc(own)),
                                                         short(rows.disc(other)), es, en});
    });
  };
  std::vector<int> count(own_grains, 0);
  for_each_memory([&](int i, const auto &) { count[i]++; });
  history->make_room(count, listed);
  for_each_memory([this](int i, const auto &contact) { history->add(i, contact); });
}

void PairCDEM::move_history_to_grains() {
  copy_history_to_grains();
  history_in_list = false;
}

void PairCDEM::write_restart(FILE *fp) {
  write_restart_settings(fp);
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      fwrite(&setflag[i][j], sizeof(int), 1, fp);
      fwrite(&materials[i][j], sizeof(cdem::Material), 1, fp);
    }
}

void PairCDEM::read_restart(FILE *fp) {
  read_restart_settings(fp);
  instructions = cdem::instruction_sets().front();
  allocate();
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      if (comm->me == 0) {
        utils::sfread(FLERR, &setflag[i][j], sizeof(int), 1, fp, nullptr, error);
        utils::sfread(FLERR, &materials[i][j], sizeof(cdem::Material), 1, fp, nullptr, error);
      }
      MPI_Bcast(&setflag[i][j], 1, MPI_INT, 0, world);
      MPI_Bcast(&materials[i][j], sizeof(cdem::Material), MPI_BYTE, 0, world);
      materials[j][i] = materials[i][j];
    }
}

void PairCDEM::write_restart_settings(FILE *fp) {
  const int flags[2] = {int(law), int(limit_damping)};
  fwrite(flags, sizeof(int), 2, fp);
}

void PairCDEM::read_restart_settings(FILE *fp) {
  int flags[2];
  if (comm->me == 0)
    utils::sfread(FLERR, flags, sizeof(int), 2, fp, nullptr, error);
  MPI_Bcast(flags, 2, MPI_INT, 0, world);
  law = cdem::Law(flags[0]);
  limit_damping = flags[1];
}

double PairCDEM::memory_usage() {
  return Pair::memory_usage() + rows.bytes() + double(found.capacity() * sizeof(Found)) + pairs.bytes() + slots.bytes();
}
