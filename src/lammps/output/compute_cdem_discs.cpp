// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/compute_cdem_discs.h"

#include "contacts/pair_cdem.h"
#include "grains/fix_cdem_grains.h"

#include "atom.h"
#include "update.h"

using namespace LAMMPS_NS;

const std::vector<ComputeCDEMDiscs::Field> ComputeCDEMDiscs::all_fields = {
    {"id", [](const Disc &d) { return static_cast<double>(d.id); }},
    {"disc", [](const Disc &d) { return static_cast<double>(d.number); }},
    {"x", [](const Disc &d) { return d.x; }},
    {"y", [](const Disc &d) { return d.y; }},
    {"radius", [](const Disc &d) { return d.radius; }},
    {"angle", [](const Disc &d) { return d.angle; }},
    {"type", [](const Disc &d) { return static_cast<double>(d.type); }},
    {"z", [](const Disc &) { return 0.0; }},
};

ComputeCDEMDiscs::ComputeCDEMDiscs(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg) {
  fields = Shearbox::choose_fields(lmp, fmt::format("Compute cdem/discs {}", id), narg - 3, arg + 3, all_fields);
  local_flag = 1;
  size_local_cols = static_cast<int>(fields.size());
  size_local_rows = 0;
}

void ComputeCDEMDiscs::init() {
  pair = PairCDEM::needed_by(fmt::format("Compute cdem/discs {}", id), lmp);
  grains = FixCDEMGrains::find(lmp); // the pair style has seen that there is one
}

void ComputeCDEMDiscs::compute_local() {
  invoked_local = update->ntimestep;
  if (!pair) // made after the last run, and the next is one with "pre no"
    init();
  discs.clear();
  for (const auto &[i, number, x, y, radius] : pair->report.discs()) {
    if (!(atom->mask[i] & groupbit))
      continue;
    const double angle = grains->angle(i);
    const Disc disc{atom->tag[i], number, x, y, radius, angle, atom->type[i]};
    for (const Field &f : fields)
      discs.add(f.value(disc));
  }
  array_local = discs.rows(size_local_cols);
  size_local_rows = discs.size();
}

double ComputeCDEMDiscs::memory_usage() { return discs.memory_usage(); }
