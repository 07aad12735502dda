// SPDX-License-Identifier: GPL-2.0-or-later
#include "force_kernel.h"

namespace cdem {

Kernels kernels_baseline(const ContactRules &);
#ifdef CDEM_X86_64
Kernels kernels_avx2(const ContactRules &);
#endif
#ifdef CDEM_AVX512
Kernels kernels_avx512(const ContactRules &);
#endif

std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
#ifdef CDEM_AVX512
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    names.push_back("avx512");
#endif
#ifdef CDEM_X86_64
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
    names.push_back("avx2");
#endif
  names.push_back("baseline");
  return names;
}

Kernels kernels(const ContactRules &rules, [[maybe_unused]] const std::string &instructions) {
#ifdef CDEM_AVX512
  if (instructions == "avx512")
    return kernels_avx512(rules);
#endif
#ifdef CDEM_X86_64
  if (instructions == "avx2")
    return kernels_avx2(rules);
#endif
  return kernels_baseline(rules);
}

} // namespace cdem
