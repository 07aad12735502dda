// SPDX-License-Identifier: GPL-2.0-or-later
#include "force_kernel_isa.h"

namespace cdem {
ForceKernel force_kernel_baseline(Law, bool limit_damping);
ForceKernel force_kernel_baseline(Law law, bool limit_damping) { return widest_kernel(law, limit_damping); }
} // namespace cdem
