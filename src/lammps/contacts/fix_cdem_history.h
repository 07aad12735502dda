// SPDX-License-Identifier: GPL-2.0-or-later
// fix cdem/history: made by pair style cdem, not by the user. Between rebuilds the history of contacts (what they
// remember) is in the pair style's list. This fix holds it by grain while that list is rebuilt, when grains migrate,
// and in restart files. Grains may get new ids between runs (by reset_atom_ids, or by delete_atoms without `compress
// no`): the history follows them.
#pragma once

#include "core/declaration.h"
#include "core/rules.h"
#include "host/glides.h"

#include "fix.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

// The list that has the contacts and their histories between rebuilds.
class ContactList {
public:
  // Copies the histories to the grains, by make_room() and add().
  virtual void copy_history_to_grains() = 0;
  // The same; from then on the grains have the histories, not the list.
  virtual void move_history_to_grains() = 0;
  // The same, when atoms have moved and the list is to be rebuilt: also books the energy losses of the step.
  virtual void close_list() = 0;
  // Books the energy losses of the contacts since the last call, if there is an audit.
  virtual void book_losses() = 0;

protected:
  ~ContactList() = default;
};

class FixCDEMHistory : public Fix, public Glides {
public:
  static constexpr const char *ID = "CDEM_HISTORY";
  // The most numbers of a contact: the tangential spring, those of the law, and for an audit as many dashpots.
  static constexpr int MOST = 1 + cdem::MOST_NUMBERS + 2 + cdem::MOST_NUMBERS;

  // A contact as one of its grains stores it: the id of the other grain, and the index of the disc in either. What it
  // remembers is always said of the pair in which the grain of the lower id comes first.
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

  // Forgets all contacts, and makes room for count[i] contacts of each grain i, whose id is ids[i]. They are then given
  // by add().
  void make_room(const std::vector<int> &count, const std::vector<tagint> &ids);
  // No grain will have more than `most` contacts until the next call.
  void expect_at_most(int most);
  void add(int i, const Contact &, const double *remembered);
  // The numbers that the contact remembers, or null.
  const double *find(int i, const Contact &) const;

  // Declares the numbers that contacts remember from now on. Those that had the same name before are kept, others begin
  // at 0.
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

  // Takes the histories from the list, if it has them: as a copy, or for good.
  void copy_from_list();
  void take_from_list();

  ContactList *list = nullptr;

private:
  int pack(int i, double *buf) const;
  int unpack(int i, const double *buf);

  void agree_on_room();
  bool has_new_ids() const;
  void swap_sides(int k);
  // How many numbers the contacts of a grain, n of them, are packed into.
  int packed_size(int n) const { return 2 + (3 + int(names.size())) * n; }

  std::vector<int> first, count; // per atom, into contacts
  std::vector<tagint> owner;     // id of the atom when its contacts were stored
  std::vector<Contact> contacts; // grains that arrive append theirs; make_room() clears all
  std::vector<double> numbers;   // what each contact remembers, contact by contact
  struct Number {
    std::string name;
    bool odd; // see core/declaration.h
  };
  std::vector<Number> names; // of the numbers of a contact
};

} // namespace LAMMPS_NS
