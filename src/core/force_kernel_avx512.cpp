// SPDX-License-Identifier: GPL-2.0-or-later
#include "force_kernel_isa.h"

namespace cdem {
Kernels kernels_avx512(const ContactRules &);
Kernels kernels_avx512(const ContactRules &rules) { return widest_kernels(rules); }
} // namespace cdem
