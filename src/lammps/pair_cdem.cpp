// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_cdem.h"

#include "compat.h"
#include "fix_cdem_history.h"
#include "fix_cdem_integrate.h"
#include "fix_cdem_shape.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
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

PairCDEM::PairCDEM(LAMMPS *lmp) : Pair(lmp) {
  restartinfo = 1;
  single_enable = 1;
  single_extra = 3;
  svector = new double[single_extra];
  no_virial_fdotr_compute = 1;
  centroidstressflag = CENTROID_NOTAVAIL;
  finitecutflag = 1;
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
    } else {
      error->all(FLERR, "Pair style cdem: unknown keyword {}; allowed: law, limit_damping", key);
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
  if (force->newton_pair)
    error->all(FLERR, "Pair style cdem: newton is on, must be off ('newton off' before the box is made)");
  if (!atom->sphere_flag)
    error->all(FLERR, "Pair style cdem needs atom_style sphere");
  if (!comm->ghost_velocity)
    error->all(FLERR, "Pair style cdem needs 'comm_modify vel yes'");
  if (!integrate)
    error->all(FLERR, "Pair style cdem needs a fix cdem/integrate: atoms outside its group are walls");
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->radius[i] > 0))
      error->one(FLERR, "Pair style cdem: atom {} has radius {}, must be positive", atom->tag[i], atom->radius[i]);
    if (!(atom->rmass[i] > 0))
      error->one(FLERR, "Pair style cdem: atom {} has mass {}, must be positive", atom->tag[i], atom->rmass[i]);
  }
}

void PairCDEM::init_style() {
  integrate = FixCDEMIntegrate::find(lmp);
  check_setting();
  read_shapes();
  kernel = cdem::force_kernel(law, limit_damping);
  Shearbox::request_half_size_list(lmp, this, instance_me);

  if (!history)
    history = static_cast<FixCDEMHistory *>(modify->add_fix(std::string(FixCDEMHistory::ID) + " all cdem/history"));
  history->pair = this;

  std::vector<double> mine(atom->ntypes + 1, 0.0);
  for (int i = 0; i < atom->nlocal; i++)
    mine[atom->type[i]] = std::max(mine[atom->type[i]], atom->radius[i]);
  largest_radius.resize(mine.size());
  MPI_Allreduce(mine.data(), largest_radius.data(), int(mine.size()), MPI_DOUBLE, MPI_MAX, world);
}

double PairCDEM::init_one(int i, int j) {
  if (!setflag[i][j])
    error->all(FLERR, "Pair style cdem: no pair_coeff for types {} and {}", i, j);
  return largest_radius[i] + largest_radius[j];
}

void PairCDEM::read_shapes() {
  shapes.assign(1, nullptr);
  for (int type = 1; type <= atom->ntypes; type++)
    shapes.push_back(&FixCDEMShape::shape(lmp, type));
  clumps = std::any_of(shapes.begin() + 1, shapes.end(), [](const auto *s) { return s->discs().size() > 1; });
}

void PairCDEM::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  if (atom->nghost || comm->nprocs > 1)
    Shearbox::forward_comm(lmp, integrate);
  const bool rebuilt = neighbor->ago == 0;
  if (clumps && rebuilt)
    map_rows();

  // During a step, v and omega are those of the half step; at setup they are those of the full step.
  const double forward = update->setupflag ? 0 : 0.5 * update->dt * integrate->prediction_weight();
  clumps ? fill_clump_rows(forward) : fill_disc_rows(forward);
  if (rebuilt) {
    build_list();
  } else if (clumps && turned_out_of_list()) {
    store_history();
    build_list();
  }
  history_in_list = true;
  pairs.compute_forces(kernel, rows.data(), update->setupflag ? 0 : update->dt);
  clumps ? sum_clump_forces() : sum_disc_forces();
  if (evflag)
    tally();
}

void PairCDEM::map_rows() {
  const int nall = atom->nlocal + atom->nghost;
  first_row.resize(nall + 1);
  grain_of_row.clear();
  for (int i = 0; i < nall; i++) {
    first_row[i] = int(grain_of_row.size());
    grain_of_row.insert(grain_of_row.end(), shapes[atom->type[i]]->discs().size(), i);
  }
  first_row[nall] = int(grain_of_row.size());
}

void PairCDEM::fill_disc_rows(double forward) {
  const int nall = atom->nlocal + atom->nghost;
  rows.resize(nall);
  for (int i = 0; i < nall; i++) {
    const double *const x = atom->x[i], *const v = atom->v[i], omega = atom->omega[i][2];
    rows[i] = {x[0], x[1], v[0], v[1], v[0], v[1], omega, omega};
    if (forward == 0)
      continue;
    const double *const a = integrate->state[i];
    rows[i].vx += forward * a[FixCDEMIntegrate::AX];
    rows[i].vy += forward * a[FixCDEMIntegrate::AY];
    rows[i].omega += forward * a[FixCDEMIntegrate::ALPHA];
  }
}

// A disc at offset o from the grain's centre moves with v + omega x o. Over the step it moved with the offset of the
// half step, o - dt/2 omega x o, which adds dt/2 omega^2 o.
void PairCDEM::fill_clump_rows(double forward) {
  const int nall = atom->nlocal + atom->nghost;
  const double half = update->setupflag ? 0 : 0.5 * update->dt;
  rows.resize(grain_of_row.size());
  auto *row = rows.data();
  for (int i = 0; i < nall; i++) {
    const double *const x = atom->x[i], *const v = atom->v[i], omega = atom->omega[i][2];
    const double *const a = integrate->state[i];
    const bool predict = forward != 0;
    const double vx = predict ? v[0] + forward * a[FixCDEMIntegrate::AX] : v[0];
    const double vy = predict ? v[1] + forward * a[FixCDEMIntegrate::AY] : v[1];
    const double spin = predict ? omega + forward * a[FixCDEMIntegrate::ALPHA] : omega;
    if (first_row[i + 1] - first_row[i] == 1) {
      *row++ = {x[0], x[1], v[0], v[1], vx, vy, omega, spin};
      continue;
    }
    const double inward = half * omega * omega;
    const double c = atom->radius[i] * std::cos(a[FixCDEMIntegrate::ANGLE]);
    const double s = atom->radius[i] * std::sin(a[FixCDEMIntegrate::ANGLE]);
    for (const auto &member : shapes[atom->type[i]]->discs()) {
      const double ox = c * member.x - s * member.y, oy = s * member.x + c * member.y;
      *row++ = {x[0] + ox,
                x[1] + oy,
                v[0] - omega * oy + inward * ox,
                v[1] + omega * ox + inward * oy,
                vx - spin * oy,
                vy + spin * ox,
                omega,
                spin};
    }
  }
}

// LAMMPS rebuilds its list of grain pairs when a centre has moved by half the skin. The list of disc pairs drawn from
// it also ages when a grain turns; that is for this rank alone to see to, and needs no communication.
bool PairCDEM::turned_out_of_list() const {
  const double most = 0.5 * neighbor->skin;
  for (std::size_t i = 0; i < built_at.size(); i++) {
    const Place &then = built_at[i];
    if (then.arm == 0)
      continue;
    const double dx = atom->x[i][0] - then.x, dy = atom->x[i][1] - then.y;
    const double turn = std::fabs(integrate->state[i][FixCDEMIntegrate::ANGLE] - then.angle);
    const double left = most - turn * then.arm;
    if (left < 0 || dx * dx + dy * dy > left * left)
      return true;
  }
  return false;
}

void PairCDEM::build_list() {
  find_candidates();
  sort_by_material();
  pairs.for_each([this](int k, const cdem::Material &) {
    set_constants(k);
    recall_history(k);
  });
  sums.build(pairs, rows_of(atom->nlocal), [this](int p, int q) { return row_before(p, q); });
  if (!clumps)
    return;
  built_at.resize(atom->nlocal + atom->nghost);
  for (std::size_t i = 0; i < built_at.size(); i++)
    built_at[i] = {atom->x[i][0], atom->x[i][1], integrate->state[i][FixCDEMIntegrate::ANGLE],
                   atom->radius[i] * shapes[atom->type[i]]->reach()};
}

// The order of all sums: by the id of the grain, then by the disc.
bool PairCDEM::row_before(int p, int q) const {
  const tagint tag_p = atom->tag[grain(p)], tag_q = atom->tag[grain(q)];
  return tag_p != tag_q ? tag_p < tag_q : disc(p) < disc(q);
}

double PairCDEM::disc_radius(int row) const {
  const int i = grain(row);
  return clumps ? atom->radius[i] * shapes[atom->type[i]]->discs()[disc(row)].r : atom->radius[i];
}

void PairCDEM::find_candidates() {
  candidates.clear();
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    for (int jj = 0; jj < list->numneigh[i]; jj++) {
      const int j = list->firstneigh[i][jj] & NEIGHMASK;
      if (!integrate->is_free(i) && !integrate->is_free(j))
        continue;
      if (!clumps) {
        add_candidate(i, j);
        continue;
      }
      for (int p = first_row[i]; p < first_row[i + 1]; p++)
        for (int q = first_row[j]; q < first_row[j + 1]; q++)
          if (std::hypot(rows[p].x - rows[q].x, rows[p].y - rows[q].y) <
              disc_radius(p) + disc_radius(q) + neighbor->skin)
            add_candidate(p, q);
    }
  }
}

void PairCDEM::add_candidate(int p, int q) {
  const int i = grain(p), j = grain(q);
  const bool p_first = atom->tag[i] < atom->tag[j];
  const auto [low, high] = std::minmax(atom->type[i], atom->type[j]);
  candidates.push_back({p_first ? p : q, p_first ? q : p, low * (atom->ntypes + 1) + high});
}

void PairCDEM::sort_by_material() {
  const int types = atom->ntypes + 1;
  std::vector<cdem::Material> material(types * types);
  std::vector<int> sizes(types * types, 0), next(types * types, 0);
  for (const auto &c : candidates) {
    material[c.material] = materials[c.material / types][c.material % types];
    sizes[c.material]++;
  }
  pairs.lay_out(material, sizes);

  auto segment = pairs.segments.begin();
  for (int m = 0; m < types * types; m++)
    if (sizes[m])
      next[m] = (segment++)->begin;
  for (const auto &c : candidates) {
    const int k = next[c.material]++;
    pairs.a[k] = c.a;
    pairs.b[k] = c.b;
  }
}

void PairCDEM::set_constants(int k) {
  const int i = grain(pairs.a[k]), j = grain(pairs.b[k]);
  const double mi = atom->rmass[i], mj = atom->rmass[j];
  const double m = !integrate->is_free(j) ? mi : !integrate->is_free(i) ? mj : mi * mj / (mi + mj);
  const double ra = disc_radius(pairs.a[k]), rb = disc_radius(pairs.b[k]);
  pairs.radius_sum[k] = ra + rb;
  pairs.radius_difference[k] = ra - rb;
  pairs.root_mass[k] = 2 * std::sqrt(m);
}

void PairCDEM::recall_history(int k) {
  const int i = grain(pairs.a[k]), j = grain(pairs.b[k]), p = disc(pairs.a[k]), q = disc(pairs.b[k]);
  const FixCDEMHistory::Contact *const known =
      i < atom->nlocal ? history->find_contact(i, atom->tag[j], p, q) : history->find_contact(j, atom->tag[i], q, p);
  pairs.es[k] = known ? known->es : 0;
  pairs.en[k] = known ? known->en : 0;
}

void PairCDEM::sum_disc_forces() {
  double *const f = atom->f[0], *const torque = atom->torque[0];
  for (int i = 0; i < atom->nlocal; i++) {
    const cdem::DiscForce sum = sums(pairs, i);
    f[3 * i] += sum.fx;
    f[3 * i + 1] += sum.fy;
    torque[3 * i + 2] += sum.torque;
  }
}

void PairCDEM::sum_clump_forces() {
  for (int i = 0; i < atom->nlocal; i++) {
    cdem::DiscForce sum{0, 0, 0};
    for (int p = first_row[i]; p < first_row[i + 1]; p++) {
      const cdem::DiscForce d = sums(pairs, p);
      const double ox = rows[p].x - atom->x[i][0], oy = rows[p].y - atom->x[i][1];
      sum.fx += d.fx;
      sum.fy += d.fy;
      sum.torque += d.torque + (ox * d.fy - oy * d.fx);
    }
    atom->f[i][0] += sum.fx;
    atom->f[i][1] += sum.fy;
    atom->torque[i][2] += sum.torque;
  }
}

// Energy and virial, with the branch vector from grain centre to grain centre.
void PairCDEM::tally() {
  pairs.for_each([this](int k, const cdem::Material &m) {
    if (!acts(k))
      return;
    const int i = grain(pairs.a[k]), j = grain(pairs.b[k]);
    const double *const xi = atom->x[i], *const xj = atom->x[j];
    const double energy = eflag_either ? spring_energy(k, m) : 0;
    ev_tally_xyz(i, j, atom->nlocal, force->newton_pair, energy, 0, pairs.force[k].fx, pairs.force[k].fy, 0,
                 xi[0] - xj[0], xi[1] - xj[1], 0);
  });
}

double PairCDEM::overlap(int k) const {
  const auto &a = rows[pairs.a[k]], &b = rows[pairs.b[k]];
  return pairs.radius_sum[k] - std::hypot(a.x - b.x, a.y - b.y);
}

// A pair across a border is on two ranks (or twice on one, if periodic): the owner of disc a counts it.
bool PairCDEM::counts(int k) const { return grain(pairs.a[k]) < atom->nlocal; }

// Also in the step after it opened, in which its dashpot may have a share left.
bool PairCDEM::acts(int k) const { return overlap(k) > 0 || pairs.force[k].fx != 0 || pairs.force[k].fy != 0; }

double PairCDEM::spring_energy(int k, const cdem::Material &m) const {
  if (overlap(k) <= 0)
    return 0;
  const double en = law == cdem::Law::direct ? m.kn * overlap(k) : pairs.en[k], es = pairs.es[k];
  return 0.5 * en * en / m.kn + (m.ks > 0 ? 0.5 * es * es / m.ks : 0);
}

double PairCDEM::elastic_energy() const {
  double sum = 0;
  pairs.for_each([&](int k, const cdem::Material &m) {
    if (counts(k))
      sum += spring_energy(k, m);
  });
  return sum;
}

PairCDEM::Contact PairCDEM::contact(int k, const cdem::Material &m) const {
  const int p = pairs.a[k], q = pairs.b[k];
  const double dx = rows[p].x - rows[q].x, dy = rows[p].y - rows[q].y, distance = std::hypot(dx, dy);
  const double fx = pairs.force[k].fx, fy = pairs.force[k].fy;
  constexpr double ROUND_OFF = 1e-10;

  Contact c;
  c.tag_a = atom->tag[grain(p)];
  c.tag_b = atom->tag[grain(q)];
  c.disc_a = disc(p);
  c.disc_b = disc(q);
  c.nx = dx / distance;
  c.ny = dy / distance;
  const double lever = 0.5 * (distance + pairs.radius_difference[k]);
  c.x = rows[p].x - lever * c.nx;
  c.y = rows[p].y - lever * c.ny;
  c.fn = fx * c.nx + fy * c.ny;
  c.ft = fy * c.nx - fx * c.ny;
  c.overlap = overlap(k);
  const double en = law == cdem::Law::direct ? m.kn * c.overlap : pairs.en[k];
  c.sliding = std::fabs(pairs.es[k]) >= (1 - ROUND_OFF) * m.mu * en;
  c.mine = counts(k);
  return c;
}

std::vector<PairCDEM::Contact> PairCDEM::contacts() const {
  std::vector<Contact> all;
  pairs.for_each([&](int k, const cdem::Material &m) {
    if (acts(k))
      all.push_back(contact(k, m));
  });
  return all;
}

std::vector<PairCDEM::DiscPlace> PairCDEM::discs() const {
  std::vector<DiscPlace> all;
  for (int p = 0; p < rows_of(atom->nlocal); p++)
    all.push_back({grain(p), disc(p), rows[p].x, rows[p].y, disc_radius(p)});
  return all;
}

double PairCDEM::single(int i, int j, int itype, int jtype, double, double, double, double &fforce) {
  double energy = 0;
  fforce = 0;
  std::fill_n(svector, single_extra, 0.0);
  if (i >= atom->nlocal)
    std::swap(i, j);
  auto add = [&](int k) {
    const int p = pairs.a[k], q = pairs.b[k], other = grain(p) == i ? grain(q) : grain(p);
    if (atom->tag[other] != atom->tag[j] || !acts(k))
      return;
    const Contact c = contact(k, materials[itype][jtype]);
    energy += spring_energy(k, materials[itype][jtype]);
    fforce += c.fn / std::hypot(rows[p].x - rows[q].x, rows[p].y - rows[q].y);
    svector[0] += c.fn;
    svector[1] += c.ft;
    svector[2] += pairs.es[k];
  };
  for (int p = rows_of(i); p < rows_of(i + 1); p++)
    sums.for_each(p, add);
  return energy;
}

void PairCDEM::store_history() {
  if (!history_in_list)
    return;
  std::vector<int> count(atom->nlocal, 0);
  std::vector<std::pair<int, FixCDEMHistory::Contact>> by_grain;
  pairs.for_each([&](int k, const cdem::Material &) {
    if (pairs.es[k] == 0 && pairs.en[k] == 0)
      return;
    const int a = pairs.a[k], b = pairs.b[k];
    for (const auto &[own, other] : {std::pair{a, b}, std::pair{b, a}}) {
      const int i = grain(own);
      if (i >= atom->nlocal)
        continue;
      count[i]++;
      by_grain.push_back({i, {atom->tag[grain(other)], disc(own), disc(other), pairs.es[k], pairs.en[k]}});
    }
  });
  history->store(count, by_grain);
}

void PairCDEM::release_history() {
  store_history();
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
  return Pair::memory_usage() + double(rows.capacity() * sizeof(rows[0])) + pairs.bytes() + sums.bytes();
}
