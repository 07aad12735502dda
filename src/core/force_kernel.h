// SPDX-License-Identifier: GPL-2.0-or-later
// The loops of a time step (kernels), compiled once for each instruction set and chosen at run time. All give the same
// bits, except those for x86-64 without fused multiply-add (see lanes.h).
#pragma once

#include "clump_motion.h"
#include "disc_motion.h"
#include "force_slots.h"
#include "rules.h"

#include <string>
#include <vector>

namespace cdem {

struct Kernels {
  // Computes the forces of pairs begin ... end-1, a segment of DiscPairs.
  void (*forces)(const Disc<double> *discs, const PairColumns &, const Material &, int begin, int end, double dt);
  // Sums the forces on each disc of a block into sums[disc - first].
  void (*sum)(const SlotBlock &, Forces<double> *sums, int first);
  // Places the discs of grains begin ... end-1; half_step (s) as in clump_motion.h.
  void (*expand)(const ClumpColumns &, int begin, int end, double half_step);
  // Moves grains begin ... end-1, except walls, by a step, and places their discs; the forces on the discs have been
  // summed before. The last argument has one entry per grain, or is null; the same below.
  void (*advance_clumps)(const ClumpColumns &, int begin, int end, const StepRule &, Fastest &, Travel *);
  // For grains of one disc: sums the forces on the discs of a block and moves the discs, except walls, by a step.
  void (*advance)(const SlotBlock &, Disc<double> *, Body *, const StepRule &, Fastest &, Travel *);
};

// Names of the instruction sets that this machine can run, the fastest first; the last is always "baseline".
std::vector<std::string> instruction_sets();

// The kernels for one of these instruction sets.
Kernels kernels(const ContactRules &, const std::string &instructions);

} // namespace cdem
