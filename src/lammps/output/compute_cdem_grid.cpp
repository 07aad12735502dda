// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/compute_cdem_grid.h"

#include "comm.h"
#include "error.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

constexpr int MOST_CELLS = 100000;

const std::vector<CellFields::Field> centre = {
    {"x", [](const cdem::CellMeans &c) { return c.centre.x; }},
    {"y", [](const cdem::CellMeans &c) { return c.centre.y; }},
};

} // namespace

ComputeCDEMGrid::ComputeCDEMGrid(LAMMPS *lmp, int narg, char **arg)
    : ComputeCDEMGrid(lmp, narg, arg,
                      Shearbox::DeckWords(lmp, fmt::format("Compute cdem/grid {}", arg[0]), narg, arg, 3)) {}

ComputeCDEMGrid::ComputeCDEMGrid(LAMMPS *lmp, int narg, char **arg, Shearbox::DeckWords words)
    : Compute(lmp, narg, arg), nx(words.count("NX")), ny(words.count("NY")), fields(lmp, groupbit, words, arg, centre) {
  if (nx > MOST_CELLS / ny)
    error->all(FLERR, "{}: {} x {} cells, at most {} are allowed", words.who, nx, ny, MOST_CELLS);
  local_flag = array_flag = 1;
  extarray = 0;
  size_array_rows = nx * ny;
  size_array_cols = size_local_cols = fields.columns();
  size_local_rows = 0;
}

void ComputeCDEMGrid::init() { fields.init(); }

void ComputeCDEMGrid::take_rows(Shearbox::LocalArray &table) {
  table.clear();
  for (const std::vector<double> &row : fields.rows(nx, ny))
    for (double value : row)
      table.add(value);
}

void ComputeCDEMGrid::compute_array() {
  invoked_array = update->ntimestep;
  take_rows(global);
  array = global.rows(fields.columns());
}

// All ranks have all rows; the first one passes them on.
void ComputeCDEMGrid::compute_local() {
  invoked_local = update->ntimestep;
  take_rows(local);
  if (comm->me != 0)
    local.clear();
  array_local = local.rows(fields.columns());
  size_local_rows = local.size();
}

double ComputeCDEMGrid::memory_usage() { return local.memory_usage() + global.memory_usage(); }
