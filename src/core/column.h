// SPDX-License-Identifier: GPL-2.0-or-later
// An array that is aligned to a cache line, as the force kernels need it.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace cdem {

template <class T> struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t ALIGNMENT{64};

  CacheLineAllocator() = default;
  template <class U> CacheLineAllocator(const CacheLineAllocator<U> &) {}
  T *allocate(std::size_t n) { return static_cast<T *>(::operator new(n * sizeof(T), ALIGNMENT)); }
  void deallocate(T *p, std::size_t) { ::operator delete(p, ALIGNMENT); }
  friend bool operator==(const CacheLineAllocator &, const CacheLineAllocator &) { return true; }
  friend bool operator!=(const CacheLineAllocator &, const CacheLineAllocator &) { return false; }
};

template <class T> class Column : public std::vector<T, CacheLineAllocator<T>> {
public:
  // n entries, all zero. If this needs more memory, the old memory is freed first.
  void reset(std::size_t n) {
    if (n > this->capacity())
      Column().swap(*this);
    this->assign(n, T{});
  }
};

} // namespace cdem
