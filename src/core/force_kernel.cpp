// SPDX-License-Identifier: GPL-2.0-or-later
#include "force_kernel.h"

namespace cdem {

ForceKernel force_kernel_baseline(Law, bool limit_damping);

#ifdef CDEM_X86_64
ForceKernel force_kernel_avx2(Law, bool limit_damping);
ForceKernel force_kernel_avx512(Law, bool limit_damping);

ForceKernel force_kernel(Law law, bool limit_damping) {
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    return force_kernel_avx512(law, limit_damping);
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
    return force_kernel_avx2(law, limit_damping);
  return force_kernel_baseline(law, limit_damping);
}
#else
ForceKernel force_kernel(Law law, bool limit_damping) { return force_kernel_baseline(law, limit_damping); }
#endif

} // namespace cdem
