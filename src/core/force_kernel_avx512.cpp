// SPDX-License-Identifier: GPL-2.0-or-later
#include "force_kernel_isa.h"

namespace cdem {
Kernels kernels_avx512(Law, bool limit_damping);
Kernels kernels_avx512(Law law, bool limit_damping) { return widest_kernels(law, limit_damping); }
} // namespace cdem
