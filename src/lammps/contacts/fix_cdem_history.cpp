// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/fix_cdem_history.h"

#include "core/grain_shape.h"
#include "host/compat.h"
#include "host/find_fix.h"
#include "host/packed_state.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "lmptype.h"

#include <algorithm>
#include <climits>
#include <unordered_map>

using namespace LAMMPS_NS;

namespace {
constexpr int PER_CONTACT = 5;
constexpr tagint NOBODY = 0;

// Numbers that a grain with so many contacts is packed into.
constexpr int packed_size(int contacts) { return 2 + PER_CONTACT * contacts; }

static_assert(cdem::GrainShape::MOST_DISCS <= SHRT_MAX); // what a Contact has room for
} // namespace

FixCDEMHistory *FixCDEMHistory::find(LAMMPS *lmp) { return Shearbox::find_fix<FixCDEMHistory>(lmp); }

FixCDEMHistory::FixCDEMHistory(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  restart_global = 1;
  restart_peratom = 1;
  create_attribute = 1;
  maxexchange_dynamic = 1;
  comm_forward = 1;
  FixCDEMHistory::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
}

FixCDEMHistory::~FixCDEMHistory() {
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
}

int FixCDEMHistory::setmask() { return FixConst::PRE_EXCHANGE | FixConst::PRE_NEIGHBOR; }

void FixCDEMHistory::make_room(const std::vector<int> &count_of, const std::vector<tagint> &ids) {
  int next = 0;
  for (std::size_t i = 0; i < count_of.size(); i++) {
    first[i] = next;
    count[i] = 0;
    owner[i] = ids[i];
    next += count_of[i];
  }
  contacts.resize(next);
}

void FixCDEMHistory::expect_at_most(int most) { maxexchange = packed_size(most); }

const FixCDEMHistory::Contact *FixCDEMHistory::find_contact(int i, tagint partner, int own_disc, int other_disc) const {
  for (int k = first[i]; k < first[i] + count[i]; k++) {
    const Contact &c = contacts[k];
    if (c.partner == partner && c.own_disc == own_disc && c.other_disc == other_disc)
      return &c;
  }
  return nullptr;
}

// The next rebuild, and the next run, may find other grains, in another order: from here on the history is with the
// grains.
void FixCDEMHistory::take_from_list() {
  if (list)
    list->move_history_to_grains();
}

void FixCDEMHistory::copy_from_list() {
  if (list)
    list->copy_history_to_grains();
}

void FixCDEMHistory::pre_exchange() {
  if (list)
    list->close_list();
  agree_on_room();
}

void FixCDEMHistory::setup_pre_exchange() { agree_on_room(); }

// A grain on its way to a rank at a corner is handed on by another one.
void FixCDEMHistory::agree_on_room() {
  const int mine = maxexchange;
  MPI_Allreduce(&mine, &maxexchange, 1, MPI_INT, MPI_MAX, world);
}

void FixCDEMHistory::post_run() { take_from_list(); }

bool FixCDEMHistory::has_new_ids() const {
  int mine = 0, all;
  for (int i = 0; i < atom->nlocal; i++)
    if (count[i] > 0 && owner[i] != atom->tag[i])
      mine = 1;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MAX, world);
  return all;
}

// Both grains remember a contact, so each knows its own id in it. A partner that is not here is no neighbour any more.
void FixCDEMHistory::setup_pre_neighbor() {
  if (!has_new_ids())
    return;
  Shearbox::forward_comm(lmp, this);
  std::unordered_map<tagint, tagint> now;
  for (int i = 0; i < atom->nlocal + atom->nghost; i++)
    if (owner[i] != NOBODY)
      now[owner[i]] = atom->tag[i];
  for (int i = 0; i < atom->nlocal; i++) {
    for (int k = first[i]; k < first[i] + count[i]; k++) {
      const auto partner = now.find(contacts[k].partner);
      contacts[k].partner = partner == now.end() ? NOBODY : partner->second;
    }
    owner[i] = atom->tag[i];
  }
}

int FixCDEMHistory::pack_forward_comm(int n, int *list, double *buf, int, int *) {
  for (int k = 0; k < n; k++)
    buf[k] = ubuf(owner[list[k]]).d;
  return n;
}

void FixCDEMHistory::unpack_forward_comm(int n, int first_ghost, double *buf) {
  for (int k = 0; k < n; k++)
    owner[first_ghost + k] = (tagint)ubuf(buf[k]).i;
}

// Called before the grains are packed. LAMMPS expects a global block: an empty one.
void FixCDEMHistory::write_restart(FILE *fp) {
  copy_from_list();
  const int size = 0;
  if (comm->me == 0)
    fwrite(&size, sizeof(int), 1, fp);
}

double FixCDEMHistory::memory_usage() {
  return double((first.capacity() + count.capacity()) * sizeof(int) + owner.capacity() * sizeof(tagint) +
                contacts.capacity() * sizeof(Contact));
}

void FixCDEMHistory::grow_arrays(int nmax) {
  first.resize(nmax, 0);
  count.resize(nmax, 0);
  owner.resize(nmax, NOBODY);
}

// A fix that comes before this one may move grains to other ranks (balance) or take some away (evaporate) when its own
// pre_exchange() is called: these are the first words that we hear of it.
void FixCDEMHistory::copy_arrays(int i, int j, int) {
  take_from_list();
  first[j] = first[i];
  count[j] = count[i];
  owner[j] = owner[i];
}

void FixCDEMHistory::set_arrays(int i) {
  count[i] = 0;
  owner[i] = NOBODY;
}

int FixCDEMHistory::pack(int i, double *buf) const {
  double *out = buf;
  *out++ = count[i];
  *out++ = ubuf(owner[i]).d;
  for (int k = first[i]; k < first[i] + count[i]; k++) {
    const Contact &c = contacts[k];
    *out++ = ubuf(c.partner).d;
    *out++ = c.own_disc;
    *out++ = c.other_disc;
    *out++ = c.es;
    *out++ = c.en;
  }
  return int(out - buf);
}

int FixCDEMHistory::unpack(int i, const double *buf) {
  const double *in = buf;
  count[i] = int(*in++);
  owner[i] = (tagint)ubuf(*in++).i;
  maxexchange = std::max(maxexchange, packed_size(count[i]));
  first[i] = int(contacts.size());
  for (int k = 0; k < count[i]; k++, in += PER_CONTACT)
    contacts.push_back({(tagint)ubuf(in[0]).i, short(in[1]), short(in[2]), in[3], in[4]});
  return int(in - buf);
}

int FixCDEMHistory::pack_exchange(int i, double *buf) {
  take_from_list();
  return pack(i, buf);
}

int FixCDEMHistory::unpack_exchange(int i, double *buf) {
  take_from_list();
  return unpack(i, buf);
}

int FixCDEMHistory::pack_restart(int i, double *buf) {
  const int n = 1 + pack(i, buf + 1);
  buf[0] = n;
  return n;
}

void FixCDEMHistory::unpack_restart(int i, int nth) {
  const double *const block = Shearbox::block_of_atom(atom->extra[i], nth);
  if (int(block[0]) != 1 + packed_size(int(block[1])))
    error->one(FLERR, "Pair style cdem: the restart file is of another version of this style: contacts of atom {}",
               atom->tag[i]);
  unpack(i, block + 1);
}

int FixCDEMHistory::size_restart(int i) { return 1 + packed_size(count[i]); }

int FixCDEMHistory::maxsize_restart() {
  const int n = count.empty() ? 0 : *std::max_element(count.begin(), count.begin() + atom->nlocal);
  int most;
  MPI_Allreduce(&n, &most, 1, MPI_INT, MPI_MAX, world);
  return 1 + packed_size(most);
}
