// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles.h"

#include "cdem_create.h"
#include "command.h"
#include "compute.h"
#include "fix.h"
#include "fix_cdem_history.h"
#include "fix_cdem_integrate.h"
#include "fix_cdem_lid.h"
#include "fix_cdem_move.h"
#include "library.h"
#include "lmptype.h"
#include "pair.h"
#include "pair_cdem.h"
#include "version_cdem.h"

#include <string>

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

template <class T> Shearbox::Style command(const char *name) {
  Shearbox::Style s{"command", name};
  s.command = [](LAMMPS *lmp) -> Command * { return new T(lmp); };
  return s;
}

} // namespace

// To add a style: include its header above and name it here.
const std::vector<Shearbox::Style> &Shearbox::styles() {
  static const std::vector<Style> all = {
      pair<PairCDEM>("cdem"),
      fix<FixCDEMHistory>("cdem/history"),
      fix<FixCDEMIntegrate>("cdem/integrate"),
      fix<FixCDEMLid>("cdem/lid"),
      fix<FixCDEMMove>("cdem/move"),
      // compute<ComputeCDEMTRM>("cdem/trm"),
      command<CDEMCreate>("cdem/create"),
  };
  return all;
}

const char *Shearbox::version() { return SHEARBOX_VERSION; }

// Only LAMMPS's C interface is used here: the layout of its classes is what we can't trust before this check.
const char *Shearbox::mismatch(LAMMPS *lmp) {
  static std::string message;
  const int running = lammps_version(lmp);
  const int tagint_bytes = lammps_extract_setting(lmp, "tagint");
  if (running != LAMMPS_VERSION_NUMBER)
    message = "Shearbox was compiled for LAMMPS version " + std::to_string(LAMMPS_VERSION_NUMBER) +
              ", but this is LAMMPS " + std::to_string(running) + ": compile it again with this LAMMPS's headers";
  else if (tagint_bytes != int(sizeof(tagint)))
    message = "Shearbox was compiled for atom ids of " + std::to_string(8 * sizeof(tagint)) +
              " bits, but this LAMMPS has " + std::to_string(8 * tagint_bytes) +
              ": compile it again with the LAMMPS_SIZES of this LAMMPS";
  return message.empty() ? nullptr : message.c_str();
}
