// SPDX-License-Identifier: GPL-2.0-or-later
#include "entry/styles.h"

#include "command.h"
#include "compute.h"
#include "contacts/fix_cdem_history.h"
#include "contacts/pair_cdem.h"
#include "fix.h"
#include "grains/cdem_create.h"
#include "grains/fix_cdem_audit.h"
#include "grains/fix_cdem_grains.h"
#include "grains/fix_cdem_shape.h"
#include "motion/fix_cdem_integrate.h"
#include "motion/fix_cdem_lid.h"
#include "motion/fix_cdem_move.h"
#include "motion/verlet_cdem.h"
#include "output/compute_cdem_average.h"
#include "output/compute_cdem_contacts.h"
#include "output/compute_cdem_discs.h"
#include "output/compute_cdem_energy.h"
#include "output/compute_cdem_force.h"
#include "output/compute_cdem_grid.h"
#include "output/compute_cdem_limit.h"
#include "output/compute_cdem_signal.h"
#include "output/compute_cdem_trm.h"
#include "output/dump_cdem_local.h"
#include "output/fix_cdem_trm.h"
#include "pair.h"

using namespace LAMMPS_NS;

namespace {

template <class T> Shearbox::Style pair(const char *name) {
  Shearbox::Style s{"pair", name};
  s.pair = [](LAMMPS *lmp) -> Pair * { return new T(lmp); };
  return s;
}

template <class T> Shearbox::Style fix(const char *name) {
  Shearbox::Style s{"fix", name};
  s.fix = [](LAMMPS *lmp, int narg, char **arg) -> Fix * { return new T(lmp, narg, arg); };
  return s;
}

template <class T> Shearbox::Style compute(const char *name) {
  Shearbox::Style s{"compute", name};
  s.compute = [](LAMMPS *lmp, int narg, char **arg) -> Compute * { return new T(lmp, narg, arg); };
  return s;
}

template <class T> Shearbox::Style dump(const char *name) {
  Shearbox::Style s{"dump", name};
  s.dump = [](LAMMPS *lmp, int narg, char **arg) -> Dump * { return new T(lmp, narg, arg); };
  return s;
}

template <class T> Shearbox::Style command(const char *name) {
  Shearbox::Style s{"command", name};
  s.command = [](LAMMPS *lmp) -> Command * { return new T(lmp); };
  return s;
}

template <class T> Shearbox::Style run(const char *name) {
  Shearbox::Style s{"run", name};
  s.run = [](LAMMPS *lmp, int narg, char **arg) -> Integrate * { return new T(lmp, narg, arg); };
  return s;
}

} // namespace

// To add a style: include its header above and name it here.
const std::vector<Shearbox::Style> &Shearbox::styles() {
  static const std::vector<Style> all = {
      pair<PairCDEM>("cdem"),
      fix<FixCDEMAudit>("cdem/audit"),
      fix<FixCDEMGrains>("cdem/grains"),
      fix<FixCDEMHistory>("cdem/history"),
      fix<FixCDEMIntegrate>("cdem/integrate"),
      fix<FixCDEMShape>("cdem/shape"),
      fix<FixCDEMLid>("cdem/lid"),
      fix<FixCDEMMove>("cdem/move"),
      fix<FixCDEMTRM>("cdem/trm"),
      compute<ComputeCDEMAverage>("cdem/average"),
      compute<ComputeCDEMContacts>("cdem/contacts"),
      compute<ComputeCDEMDiscs>("cdem/discs"),
      compute<ComputeCDEMEnergy>("cdem/energy"),
      compute<ComputeCDEMForce>("cdem/force"),
      compute<ComputeCDEMGrid>("cdem/grid"),
      compute<ComputeCDEMLimit>("cdem/limit"),
      compute<ComputeCDEMSignal>("cdem/signal"),
      compute<ComputeCDEMTRM>("cdem/trm"),
      dump<DumpCDEMLocal>("cdem/local"),
      command<CDEMCreate>("cdem/create"),
      run<VerletCDEM>("verlet/cdem"),
  };
  return all;
}

const std::vector<Shearbox::Style> *shearbox_styles() { return &Shearbox::styles(); }
