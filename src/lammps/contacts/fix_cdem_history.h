// SPDX-License-Identifier: GPL-2.0-or-later
// fix cdem/history: made by pair style cdem, not by the user. Between rebuilds the history of contacts lives in the
// pair style's list; this fix holds it by grain while that list is rebuilt, when grains migrate, and in restart files.
// Grains may be given other ids between runs (delete_atoms does so, unless it is told `compress no`, reset_atom_ids
// too): the history follows.
#pragma once

#include "core/declaration.h"
#include "host/glides.h"

#include "fix.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

// Where contacts and their histories are between rebuilds.
class ContactList {
public:
  virtual ~ContactList() = default;
  // To the grains, by make_room() and add(), of what the list has.
  virtual void copy_history_to_grains() = 0;
  // The same; the list is no longer the place where it is kept.
  virtual void move_history_to_grains() = 0;
  // The same, once the atoms have moved on: the list is to be rebuilt.
  virtual void close_list() = 0;
};

class FixCDEMHistory : public Fix, public Glides {
public:
  static constexpr const char *ID = "CDEM_HISTORY";

  // A contact as one of its grains knows it: the other grain, and the disc of either. What it remembers is in the sense
  // of the pair, whose first disc belongs to the grain of the lower id.
  struct Contact {
    tagint partner;
    short own_disc, other_disc;
    bool operator==(const Contact &c) const {
      return partner == c.partner && own_disc == c.own_disc && other_disc == c.other_disc;
    }
  };

  // The fix of this style, or null.
  static FixCDEMHistory *find(LAMMPS *);

  FixCDEMHistory(LAMMPS *, int, char **);
  ~FixCDEMHistory() override;

  // Forgets all and makes room for so many contacts of each grain, of these ids, which are added then.
  void make_room(const std::vector<int> &count, const std::vector<tagint> &ids);
  // No grain will have more contacts than this, until this is called again.
  void expect_at_most(int most);
  void add(int i, const Contact &, const double *remembered);
  // What the contact remembers, or null.
  const double *find(int i, const Contact &) const;

  // The numbers that contacts remember from now on. Those known by the same name before are kept, others begin at 0.
  void remember(const std::vector<cdem::Remembered> &);

  int setmask() override;
  void pre_exchange() override;
  void setup_pre_exchange() override;
  void setup_pre_neighbor() override;
  void post_run() override;
  double memory_usage() override;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;

  // From the list, if that has it: a copy, or all from now on.
  void copy_from_list();
  void take_from_list();

  ContactList *list = nullptr;

private:
  int pack(int i, double *buf) const;
  int unpack(int i, const double *buf);

  void agree_on_room();
  bool has_new_ids() const;
  void swap_sides(int k);
  // Numbers that a grain with so many contacts is packed into.
  int packed_size(int n) const { return 2 + (3 + int(names.size())) * n; }

  std::vector<int> first, count; // per atom, into contacts
  std::vector<tagint> owner;     // the atom's id as its contacts know it
  std::vector<Contact> contacts; // arriving grains append; make_room() starts afresh
  std::vector<double> numbers;   // of each contact, one after the other
  struct Number {
    std::string name;
    bool odd; // see core/declaration.h
  };
  std::vector<Number> names; // of the numbers of a contact
};

} // namespace LAMMPS_NS
