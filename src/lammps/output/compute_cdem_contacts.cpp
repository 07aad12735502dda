// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/compute_cdem_contacts.h"

#include "atom.h"
#include "error.h"
#include "update.h"

#include <algorithm>
#include <string>

using namespace LAMMPS_NS;

const std::vector<ComputeCDEMContacts::Field> ComputeCDEMContacts::all_fields = {
    {"id1", [](const Contact &c) { return static_cast<double>(c.tag_a); }},
    {"id2", [](const Contact &c) { return static_cast<double>(c.tag_b); }},
    {"disc1", [](const Contact &c) { return static_cast<double>(c.disc_a); }},
    {"disc2", [](const Contact &c) { return static_cast<double>(c.disc_b); }},
    {"x", [](const Contact &c) { return c.x; }},
    {"y", [](const Contact &c) { return c.y; }},
    {"fn", [](const Contact &c) { return c.fn; }},
    {"ft", [](const Contact &c) { return c.ft; }},
    {"fx", [](const Contact &c) { return c.fn * c.nx - c.ft * c.ny; }},
    {"fy", [](const Contact &c) { return c.fn * c.ny + c.ft * c.nx; }},
    {"nx", [](const Contact &c) { return c.nx; }},
    {"ny", [](const Contact &c) { return c.ny; }},
    {"overlap", [](const Contact &c) { return c.overlap; }},
    {"sliding", [](const Contact &c) { return c.sliding ? 1.0 : 0.0; }},
};

ComputeCDEMContacts::ComputeCDEMContacts(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg) {
  std::vector<Field> known = all_fields;
  for (const Field &f : fields_of_laws())
    known.push_back(f);
  fields = narg == 3
               ? all_fields
               : Shearbox::choose_fields(lmp, fmt::format("Compute cdem/contacts {}", id), narg - 3, arg + 3, known);
  local_flag = 1;
  size_local_cols = static_cast<int>(fields.size());
  size_local_rows = 0;
}

// The law in use, and so the place of each of its numbers, is only known when a run begins.
std::vector<ComputeCDEMContacts::Field> ComputeCDEMContacts::fields_of_laws() const {
  std::vector<Field> all;
  for (const std::string &name : cdem::all_remembered())
    all.push_back({name, [this, name](const Contact &c) { return c.remembered[place_of(name)]; }});
  return all;
}

std::size_t ComputeCDEMContacts::place_of(const std::string &number) const {
  const auto &remembered = pair->contacts.law.remembered();
  for (std::size_t m = 0; m < remembered.size(); m++)
    if (remembered[m].name == number)
      return m;
  error->all(FLERR, "Compute cdem/contacts {}: contacts of the law in use have no {}", id, number);
  return 0; // not reached
}

void ComputeCDEMContacts::init() {
  pair = PairCDEM::needed_by(fmt::format("Compute cdem/contacts {}", id), lmp);
  for (const std::string &number : cdem::all_remembered())
    if (std::any_of(fields.begin(), fields.end(), [&](const Field &f) { return f.name == number; }))
      place_of(number); // an error if the law does not have it
}

// Ids of the group's atoms that this rank knows, ghosts included, in ascending order.
std::vector<tagint> ComputeCDEMContacts::members() const {
  std::vector<tagint> ids;
  for (int i = 0; i < atom->nlocal + atom->nghost; i++)
    if (atom->mask[i] & groupbit)
      ids.push_back(atom->tag[i]);
  std::sort(ids.begin(), ids.end());
  return ids;
}

void ComputeCDEMContacts::compute_local() {
  invoked_local = update->ntimestep;
  if (!pair) // made after the last run, and the next is one with "pre no"
    init();
  const std::vector<tagint> group = members();
  const auto in_group = [&](tagint id) { return std::binary_search(group.begin(), group.end(), id); };
  contacts.clear();
  for (const Contact &c : pair->report.contacts()) {
    if (!c.mine || !in_group(c.tag_a) || !in_group(c.tag_b))
      continue;
    for (const Field &f : fields)
      contacts.add(f.value(c));
  }
  array_local = contacts.rows(size_local_cols);
  size_local_rows = contacts.size();
}

double ComputeCDEMContacts::memory_usage() { return contacts.memory_usage(); }
