// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/fix_cdem_history.h"

#include "core/grain_shape.h"
#include "core/rules.h"
#include "host/compat.h"
#include "host/find_fix.h"
#include "host/packed_state.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "lmptype.h"
#include "update.h"

#include <algorithm>
#include <climits>
#include <unordered_map>

using namespace LAMMPS_NS;

namespace {
constexpr tagint NOBODY = 0;

// The names of the remembered numbers, in restart files.
struct Names {
  static constexpr int VERSION = 3;
  int count;
  char name[FixCDEMHistory::MOST][cdem::LONGEST_NAME + 1];
};

static_assert(cdem::GrainShape::MOST_DISCS <= SHRT_MAX); // a Contact stores the index of a disc as short
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
  numbers.resize(next * names.size());
}

void FixCDEMHistory::expect_at_most(int most) { maxexchange = packed_size(most); }

void FixCDEMHistory::add(int i, const Contact &contact, const double *remembered) {
  const int k = first[i] + count[i]++;
  contacts[k] = contact;
  std::copy_n(remembered, names.size(), &numbers[k * names.size()]);
}

const double *FixCDEMHistory::find(int i, const Contact &contact) const {
  for (int k = first[i]; k < first[i] + count[i]; k++)
    if (contacts[k] == contact)
      return &numbers[k * names.size()];
  return nullptr;
}

void FixCDEMHistory::remember(const std::vector<cdem::Remembered> &declared) {
  std::vector<Number> now;
  for (const auto &[name, unit, odd] : declared)
    now.push_back({name, odd});
  std::vector<double> renewed(contacts.size() * now.size(), 0);
  for (std::size_t n = 0; n < now.size(); n++)
    for (std::size_t m = 0; m < names.size(); m++)
      if (now[n].name == names[m].name)
        for (std::size_t k = 0; k < contacts.size(); k++)
          renewed[k * now.size() + n] = numbers[k * names.size() + m];
  numbers = std::move(renewed);
  names = std::move(now);
}

// Before grains are moved or numbered anew: from here on the history is with the grains, not in the list.
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

// A grain that moves to a diagonal neighbour takes two hops, so the buffers of all ranks must be as large as the
// largest.
void FixCDEMHistory::agree_on_room() {
  const int mine = maxexchange;
  MPI_Allreduce(&mine, &maxexchange, 1, MPI_INT, MPI_MAX, world);
}

// Between runs the list still has the histories, until somebody needs them here: grains come or go, a restart file is
// written, another run begins. The books are read before.
void FixCDEMHistory::post_run() {
  if (list)
    list->book_losses();
}

bool FixCDEMHistory::has_new_ids() const {
  int mine = 0, all;
  for (int i = 0; i < atom->nlocal; i++)
    if (owner[i] != atom->tag[i])
      mine = 1;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MAX, world);
  return all;
}

// Grains may have new ids. Each grain knows its own old id (`owner`), and ghosts tell theirs: so the ids of partners
// can be renewed. A partner that is not on this rank, also not as a ghost, is not a neighbour any more. Nor is one that
// is gone and whose id a new grain has, as this one has no old id.
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
      const tagint known = partner == now.end() ? NOBODY : partner->second;
      if ((owner[i] < contacts[k].partner) != (atom->tag[i] < known))
        swap_sides(k);
      contacts[k].partner = known;
    }
    owner[i] = atom->tag[i];
  }
}

// Of the two grains of contact k, the other one has the lower id now: numbers that depend on the order change their
// sign.
void FixCDEMHistory::swap_sides(int k) {
  for (std::size_t m = 0; m < names.size(); m++)
    if (names[m].odd)
      numbers[k * names.size() + m] *= -1;
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

// LAMMPS calls this before it packs the grains.
void FixCDEMHistory::write_restart(FILE *fp) {
  copy_from_list();
  if (comm->me != 0)
    return;
  Names file{int(names.size()), {}};
  for (std::size_t m = 0; m < names.size(); m++)
    names[m].name.copy(file.name[m], sizeof(file.name[m]) - 1);
  Shearbox::write_state(fp, file);
}

void FixCDEMHistory::restart(char *buf) {
  const auto file = Shearbox::read_state<Names>(lmp, style, buf);
  names.clear();
  for (int m = 0; m < file.count; m++)
    names.push_back({file.name[m], false});
}

double FixCDEMHistory::memory_usage() {
  return double((first.capacity() + count.capacity()) * sizeof(int) + owner.capacity() * sizeof(tagint) +
                contacts.capacity() * sizeof(Contact) + numbers.capacity() * sizeof(double));
}

void FixCDEMHistory::grow_arrays(int nmax) {
  first.resize(nmax, 0);
  count.resize(nmax, 0);
  owner.resize(nmax, NOBODY);
}

// A fix that comes before this one may move grains to other ranks (balance) or take some away (evaporate) in its own
// pre_exchange(). Then this call is our first notice.
void FixCDEMHistory::copy_arrays(int i, int j, int) {
  take_from_list();
  first[j] = first[i];
  count[j] = count[i];
  owner[j] = owner[i];
}

// Between runs a new grain may take the place of one that is gone, and must not get its contacts.
void FixCDEMHistory::set_arrays(int i) {
  if (update->whichflag == 0)
    take_from_list();
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
    out = std::copy_n(&numbers[k * names.size()], names.size(), out);
  }
  return int(out - buf);
}

int FixCDEMHistory::unpack(int i, const double *buf) {
  const double *in = buf;
  count[i] = int(*in++);
  owner[i] = (tagint)ubuf(*in++).i;
  maxexchange = std::max(maxexchange, packed_size(count[i]));
  first[i] = int(contacts.size());
  for (int k = 0; k < count[i]; k++) {
    contacts.push_back({(tagint)ubuf(in[0]).i, short(in[1]), short(in[2])});
    numbers.insert(numbers.end(), in + 3, in + 3 + names.size());
    in += 3 + names.size();
  }
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
  return Shearbox::HEAD_OF_ATOM + pack(i, Shearbox::begin_atom(buf, atom->tag[i], packed_size(count[i])));
}

void FixCDEMHistory::unpack_restart(int i, int nth) {
  const auto size = [this](const double *numbers) { return packed_size(int(numbers[0])); };
  unpack(i, Shearbox::state_of_atom(lmp, style, i, nth, size));
}

int FixCDEMHistory::size_restart(int i) { return Shearbox::HEAD_OF_ATOM + packed_size(count[i]); }

int FixCDEMHistory::maxsize_restart() {
  const int n = count.empty() ? 0 : *std::max_element(count.begin(), count.begin() + atom->nlocal);
  int most;
  MPI_Allreduce(&n, &most, 1, MPI_INT, MPI_MAX, world);
  return Shearbox::HEAD_OF_ATOM + packed_size(most);
}
