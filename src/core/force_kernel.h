// SPDX-License-Identifier: GPL-2.0-or-later
// The loops of a time step, compiled once for each instruction set of the machine's family and chosen at run time. All
// give the same bits, except those for x86-64 without fused multiply-add (see lanes.h).
#pragma once

#include "clump_motion.h"
#include "disc_motion.h"
#include "force_slots.h"
#include "rules.h"

#include <string>
#include <vector>

namespace cdem {

struct Kernels {
  // The forces of pairs begin ... end-1, a segment of DiscPairs.
  void (*forces)(const Disc<double> *discs, const PairColumns &, const Material &, int begin, int end, double dt);
  // Sums the forces of a block's discs, to sums[disc - first].
  void (*sum)(const SlotBlock &, Forces<double> *sums, int first);
  // Places the discs of grains begin ... end-1; half_step as in clump_motion.h.
  void (*expand)(const ClumpColumns &, int begin, int end, double half_step);
  // Moves those of them that are no walls by a step, once the forces on their discs are summed. The last argument, one
  // for each grain, may be null; so below.
  void (*advance_clumps)(const ClumpColumns &, int begin, int end, const StepRule &, Fastest &, Travel *);
  // Sums the forces of a block's discs, and moves these by a step, but for walls.
  void (*advance)(const SlotBlock &, Disc<double> *, Body *, const StepRule &, Fastest &, Travel *);
};

// Names of the instruction sets that this machine can run, the fastest first; the last is always "baseline".
std::vector<std::string> instruction_sets();

// Those of one of them.
Kernels kernels(const ContactRules &, const std::string &instructions);

} // namespace cdem
