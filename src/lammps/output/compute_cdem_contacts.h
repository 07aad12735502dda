// SPDX-License-Identifier: GPL-2.0-or-later
// compute ID group cdem/contacts [field ...]
//
// The contacts of pair style cdem at the end of the step, each once for any number of ranks. Both grains (or the grain
// and the wall disc) must be in the group.
//
// Local array: one row per contact, one column per field, in the order given; by default all of these:
//
//   id1 id2      ids of the two grains, id1 < id2
//   disc1 disc2  number of the disc within its grain, from 0
//   x y          contact point, in the middle of the overlap (m)
//   fn ft        normal and tangential force with their dashpots and additions to the law (N); fn > 0 repels
//   fx fy        force on grain 1 (N): fn n + ft t, with t = (-ny, nx). Grain 2 gets the opposite
//   nx ny        unit normal, from disc 2 to disc 1
//   overlap      (m); negative if the contact opened within the step and a part of its force still acts
//   sliding      1 if the tangential spring is at the Coulomb limit fn_spring tan(phi), else 0
//
// and, only if they are named, the numbers that contacts remember in the law in use; a name that it does not have is an
// error when the run begins:
//
//   es           tangential spring (N)
//   en           normal spring of law incremental (N)
//   rolling      torque of the rolling resistance's spring on grain 1 (N m)
//
// For example:  compute c all cdem/contacts x y fn sliding
//               dump d all cdem/local 1000 contacts.dump c_c[*]
//               dump_modify d format float %.9g     # ids beyond 999999 want more than the default %g
//
// Needs pair_style cdem.
#pragma once

#include "contacts/pair_cdem.h"
#include "host/local_array.h"
#include "host/named_columns.h"
#include "output/named_fields.h"

#include "compute.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class ComputeCDEMContacts : public Compute, public Shearbox::NamedColumns {
public:
  ComputeCDEMContacts(LAMMPS *, int, char **);

  void init() override;
  void compute_local() override;
  double memory_usage() override;
  std::vector<std::string> column_names() const override { return Shearbox::names_of(fields); }

private:
  using Contact = ContactReport::Contact;
  using Field = Shearbox::Field<Contact>;
  static const std::vector<Field> all_fields; // those of any law

  std::vector<Field> fields_of_laws() const;
  std::size_t place_of(const std::string &number) const;
  std::vector<tagint> members() const;

  std::vector<Field> fields;
  const PairCDEM *pair = nullptr;
  Shearbox::LocalArray contacts;
};

} // namespace LAMMPS_NS
